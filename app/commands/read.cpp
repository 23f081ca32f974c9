#include "vicon/viewer/qt/reading_room.h"

#include <filesystem>

#include "../command.h"
#include "../marking.h"
#include "../report_writing.h"
#include "../worklist.h"
#include "vicon/pipeline/queue.h"

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

viewer::WorklistRow rowOf(CaseStore& store, const WorklistCase& from)
{
    viewer::WorklistRow row{from.record, from.state, from.reason, 0, from.markers, reportsOf(store, from.record.id),
                            {}};
    int jobs = 0;
    for (const WorklistScan& scan : from.scans) {
        row.scans.push_back({scan.record, scan.state, scan.step, scan.progress, scan.reason, scan.folder});
        if (scan.state == "kept")
            continue;
        row.progress += scan.progress;
        ++jobs;
    }
    if (jobs > 0)
        row.progress /= jobs;
    return row;
}

viewer::ReadingServices servicesOf(Context& context)
{
    viewer::ReadingServices services;
    services.store = context.existingStore().folder();
    const Config& config = context.config();
    services.worklist = [&config](CaseStore& store) {
        std::vector<viewer::WorklistRow> rows;
        for (const WorklistCase& a_case : makeWorklist(store, config))
            rows.push_back(rowOf(store, a_case));
        return rows;
    };
    services.retry = [&config](CaseStore& store, const std::string& case_id) {
        pipeline::JobQueue queue(store.database(), config.get<pipeline::QueueOptions>());
        for (const ScanRecord& scan : store.scans(case_id))
            if (const auto job = queue.find(case_id, scan.id); job && job->state == pipeline::JobState::failed)
                queue.retry(case_id, scan.id);
    };
    services.place = [&config](CaseStore& store, const std::string& case_id, Marker marker) {
        return placeMarker(store, config.get<MarkOptions>(), case_id, std::move(marker));
    };
    services.report = [&config](CaseStore& store, const std::string& case_id) {
        NoProgress progress;
        return writeReport(store, config, case_id, {}, progress).file;
    };
    return services;
}

}  // namespace

Subcommand readCommand()
{
    return {"read", "The reading room: worklist and viewer", [](CLI::App& command) {
                auto case_id = std::make_shared<std::string>();
                command.add_option("CASE", *case_id, "Open this case at once");
                return [case_id](Context& context) {
                    const auto services = servicesOf(context);
                    const std::string id = case_id->empty() ? "" : context.existingStore().requireCase(*case_id).id;
                    return viewer::runReadingRoom(services, id, stopRequested());
                };
            }};
}

}  // namespace vicon::app
