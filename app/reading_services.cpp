#include "reading_services.h"

#include <unistd.h>

#include <array>
#include <filesystem>
#include <vector>

#include "correcting.h"
#include "marking.h"
#include "report_writing.h"
#include "scan_work.h"
#include "text_table.h"
#include "vicon/cases/job_queue.h"
#include "vicon/ingest/receiver.h"
#include "vicon/pipeline/worker.h"
#include "worklist.h"

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

int reportsOf(CaseStore& store, const std::string& case_id)
{
    std::error_code none;
    int count = 0;
    for (const auto& entry : fs::directory_iterator(store.caseFolder(case_id) / "report", none))
        count += entry.path().extension() == ".pdf" ? 1 : 0;
    return count;
}

/// What a radiologist asks first: what does it show, is it distended, is there fluid, is anything collapsed.
void addFindings(CaseStore& store, viewer::WorklistScanRow& row)
{
    for (const StepRecord& step : store.steps(row.record.case_id, row.record.id)) {
        if (step.result.contains("organ"))
            row.organ = step.result["organ"].get<std::string>();
        if (step.step != "quality" || !step.result.contains("quality"))
            continue;
        const nlohmann::json& quality = step.result["quality"];
        row.adequate = quality.value("adequate", true);
        row.quality = "radius " + formatNumber(quality.value("median_radius_mm", 0.0), 0) + " mm, fluid " +
                      formatNumber(100 * quality.value("fluid_fraction", 0.0), 0) + " %";
        const std::string reason = quality.value("reason", "");
        row.quality += reason.empty() ? ", nothing collapsed" : ", " + reason;
    }
}

viewer::WorklistRow rowOf(CaseStore& store, const WorklistCase& from)
{
    viewer::WorklistRow row{from.record, from.state, from.reason, 0, from.markers, reportsOf(store, from.record.id),
                            {}};
    int jobs = 0;
    for (const WorklistScan& scan : from.scans) {
        row.scans.push_back({scan.record, scan.state, scan.step, scan.progress, scan.reason, scan.folder, {}});
        addFindings(store, row.scans.back());
        if (!scan.reason.empty())
            row.scans.back().corrected = !pipeline::readCorrections(scan.folder).empty();
        if (scan.state == "kept")
            continue;
        row.progress += scan.progress;
        ++jobs;
    }
    if (jobs > 0)
        row.progress /= jobs;
    return row;
}

Point3 pointOf(const nlohmann::json& json)
{
    return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

std::vector<viewer::BridgeRow> bridgesOf(CaseStore& store, const ScanRecord& scan)
{
    std::vector<viewer::BridgeRow> rows;
    for (const nlohmann::json& bridge : reviewedBridges(store, scan)) {
        const nlohmann::json review = bridge.value("review", nlohmann::json::object());
        rows.push_back({pointOf(bridge.at("from_mm")), pointOf(bridge.at("to_mm")), bridge.value("length_mm", 0.0),
                        bridge.value("confidence", 0.0), bridge.value("certain", true), bridge.value("reason", ""),
                        review.value("verdict", ""), review.value("by", ""), review.value("at", "")});
    }
    return rows;
}

/// What is corrected while the queue runs is out of date when its job is done: then it runs again.
void runQueue(CaseStore& store, const Config& config, const std::atomic<bool>& stop)
{
    auto options = config.get<pipeline::WorkOptions>();
    options.until_idle = true;
    std::vector<Job> done;
    pipeline::WorkerEvents events;
    events.ended = [&](const Job& job, JobState state, const std::string&) {
        if (state == JobState::done)
            done.push_back(job);
    };
    do {
        done.clear();
        pipeline::runWorker(store, config.get<QueueOptions>(), options, scanWork(store, config), events, stop);
        for (const Job& job : done)
            requeueOutdated(store, config, job.case_id, job.scan_id);
    } while (!stop && !done.empty());
}

void addCorrections(viewer::ReadingServices& services, const Config& config)
{
    services.corrections = [](CaseStore& store, const ScanRecord& scan) {
        const auto known = pipeline::readCorrections(store.scanFolder(scan.case_id, scan.id));
        return viewer::ScanCorrections{known.add, known.cut, known.drop};
    };
    services.correct = [&config](CaseStore& store, const ScanRecord& scan, const viewer::ScanCorrections& all) {
        constexpr bool kForget = true;  // what was said before: it is among them, or was taken back
        correctScan(store, config, scan, {all.add, all.cut, all.drop}, kForget);
        requeueOutdated(store, config, scan.case_id, scan.id);
    };
    services.bridges = bridgesOf;
    services.review_bridge = [](CaseStore& store, const ScanRecord& scan, const viewer::BridgeRow& bridge) {
        reviewBridge(store, scan, {bridge.from_mm, bridge.to_mm, bridge.verdict, bridge.by, bridge.at});
    };
    services.work = [&config](CaseStore& store, const std::atomic<bool>& stop) { runQueue(store, config, stop); };
}

void retry(CaseStore& store, const Config& config, const std::string& case_id)
{
    JobQueue queue(store.database(), config.get<QueueOptions>());
    const auto a_case = makeWorklistCase(store, config, store.requireCase(case_id));
    for (const viewer::WorklistScanRow& scan : rowOf(store, a_case).scans)
        if (scan.state == "failed")
            queue.retry(case_id, scan.record.id);
        else if (scan.spoiled())
            correctScan(store, config, scan.record, {}, true);
    requeueOutdated(store, config, case_id);
}

std::string receiverOf(const Config& config)
{
    const auto options = config.get<ingest::ReceiverOptions>();
    std::array<char, 256> host{};
    const bool known = ::gethostname(host.data(), host.size() - 1) == 0;
    return options.ae_title + " (" + (known ? host.data() : "this machine") + ", port " + std::to_string(options.port) +
           ")";
}

}  // namespace

viewer::ReadingServices readingServices(const fs::path& store, const Config& config)
{
    viewer::ReadingServices services;
    services.store = store;
    services.receiver = receiverOf(config);
    services.worklist = [&config](CaseStore& store) {
        std::vector<viewer::WorklistRow> rows;
        for (const WorklistCase& a_case : makeWorklist(store, config))
            rows.push_back(rowOf(store, a_case));
        return rows;
    };
    services.worklist_version = [](CaseStore& store) { return store.database().version(); };
    services.retry = [&config](CaseStore& store, const std::string& case_id) { retry(store, config, case_id); };
    services.place = [&config](CaseStore& store, const std::string& case_id, Marker marker) {
        return placeMarker(store, config.get<MarkOptions>(), case_id, std::move(marker));
    };
    services.import_markers = [&config](CaseStore& store, const std::string& case_id, const fs::path& file) {
        return importOf(store, config.get<MarkOptions>(), case_id, file);
    };
    addCorrections(services, config);
    services.report = [&config](CaseStore& store, const std::string& case_id) {
        NoProgress progress;
        return writeReport(store, config, case_id, {}, progress).file;
    };
    return services;
}

}  // namespace vicon::app
