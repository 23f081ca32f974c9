#include "scan_work.h"

#include "vicon/cases/placing.h"
#include "vicon/ingest/load_scan.h"

namespace vicon::app {

pipeline::JobWork scanWork(CaseStore& store, const Config& config)
{
    const auto options = config.get<ingest::ImportOptions>();
    auto work = pipeline::makeScanWork(
        store, config,
        [options](const std::filesystem::path& folder, Progress& progress) {
            return ingest::loadScan(folder, options, progress);
        },
        toJson(options));
    // A new skeleton gives the markers of its scan new stations.
    return [&store, mark = config.get<MarkOptions>(), work = std::move(work)](pipeline::JobContext& job_context) {
        work(job_context);
        renewPlaces(store, mark, job_context.job().case_id, job_context.job().scan_id);
    };
}

void requeueOutdated(CaseStore& store, const Config& config)
{
    JobQueue queue(store.database(), config.get<QueueOptions>());
    for (const Job& job : queue.jobs())
        if (job.state == JobState::done &&
            pipeline::isOutdated(store, config, toJson(config.get<ingest::ImportOptions>()), job.case_id, job.scan_id))
            queue.retry(job.case_id, job.scan_id);
}

}  // namespace vicon::app
