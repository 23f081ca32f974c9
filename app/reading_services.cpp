#include "reading_services.h"

#include <unistd.h>

#include <array>
#include <filesystem>
#include <vector>

#include "priors.h"
#include "report_known.h"
#include "report_pictures.h"
#include "report_writing.h"
#include "scan_work.h"
#include "vicon/cases/bridges.h"
#include "vicon/cases/corrections.h"
#include "vicon/cases/placing.h"
#include "vicon/cases/report_content.h"
#include "vicon/cases/worklist.h"
#include "vicon/core/file.h"
#include "vicon/ingest/receiver.h"
#include "vicon/pipeline/worker.h"
#include "vicon/report/forms.h"

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

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

void addCorrectionServices(viewer::ReadingServices& services, const Config& config)
{
    services.corrections = [](CaseStore& store, const ScanRecord& scan) {
        return readCorrections(store.scanFolder(scan.case_id, scan.id));
    };
    services.correct = [&config](CaseStore& store, const ScanRecord& scan, const Corrections& before,
                                 const Corrections& after) {
        replaceCorrections(store, config.get<QueueOptions>(), scan, after, before);
        requeueOutdated(store, config, scan.case_id, scan.id);
    };
    services.bridges = reviewedBridges;
    services.review_bridge = reviewBridge;
    services.work = [&config](CaseStore& store, const std::atomic<bool>& stop) { runQueue(store, config, stop); };
}

std::string textOfReport(CaseStore& store, const std::string& case_id)
{
    const std::vector<ReportVersion> versions = reportVersions(store, case_id);
    if (versions.empty() || reportStatus(store, case_id).open())
        return report::asText(readCase(store, case_id), std::nullopt);
    return report::asText(readCaseFromContent(nlohmann::json::parse(versions.back().content)), versions.back());
}

std::string pdfOfReport(CaseStore& store, const Config& config, const std::string& case_id, Progress& progress)
{
    const std::vector<ReportVersion> versions = reportVersions(store, case_id);
    if (!versions.empty() && !reportStatus(store, case_id).open())
        return readFile(versions.back().file);
    return previewReport(store, config, case_id, progress);
}

void addReportServices(viewer::ReportServices& services, const Config& config)
{
    services.texts = config.get<ReportTexts>();
    services.known = knownOf;
    services.text = textOfReport;
    services.pdf = [&config](CaseStore& store, const std::string& case_id, Progress& progress) {
        return pdfOfReport(store, config, case_id, progress);
    };
    services.sign = [&config](CaseStore& store, const std::string& case_id, Progress& progress) {
        return giveOutReport(store, config, case_id, true, progress).version;
    };
    services.amend = [&config](CaseStore& store, const std::string& case_id, const std::string& reason) {
        beginAmendment(store, config.get<SigningOptions>(), case_id, reason);
    };
    services.cancel_amendment = [&config](CaseStore& store, const std::string& case_id) {
        cancelAmendment(store, config.get<SigningOptions>(), case_id);
    };
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

viewer::ReadingServices readingServices(const StorePlace& store, const Config& config)
{
    viewer::ReadingServices services;
    services.store = store;
    services.receiver = receiverOf(config);
    services.worklist = [&config](CaseStore& store, const WorklistPageWanted& wanted) {
        return makeWorklistPage(store, config.get<QueueOptions>(), wanted);
    };
    services.worklist_case = [&config](CaseStore& store, const std::string& case_id) -> std::optional<WorklistCase> {
        const auto record = store.findCase(case_id);
        if (!record)
            return {};
        return makeWorklistCase(store, config.get<QueueOptions>(), *record);
    };
    services.worklist_version = [](CaseStore& store) { return store.database().version(); };
    services.opened = [&config](CaseStore& store, const std::string& case_id) {
        JobQueue(store.database(), config.get<QueueOptions>()).putFirst(case_id);
    };
    services.retry = [&config](CaseStore& store, const std::string& case_id) {
        retryCase(store, config.get<QueueOptions>(), case_id);
        requeueOutdated(store, config, case_id);
    };
    services.place = [&config](CaseStore& store, const std::string& case_id, Marker marker) {
        return placeMarker(store, config.get<MarkOptions>(), case_id, std::move(marker));
    };
    services.import_markers = [&config](CaseStore& store, const std::string& case_id, const fs::path& file,
                                        Progress& progress) {
        return importOf(store, config.get<MarkOptions>(), case_id, file, progress);
    };
    services.renew_places = [&config](CaseStore& store, const std::string& case_id) {
        return renewPlaces(store, config.get<MarkOptions>(), case_id);
    };
    addCorrectionServices(services, config);
    addReportServices(services.reporting, config);
    services.priors = {config.get<PriorOptions>(), priorsOf, imagedScans};
    services.report = [&config](CaseStore& store, const std::string& case_id, Progress& progress) {
        return writeReport(store, config, case_id, {}, progress).file;
    };
    return services;
}

}  // namespace vicon::app
