#include "scan_work.h"

#include <algorithm>

#include "vicon/cases/placing.h"
#include "vicon/ingest/load_scan.h"

namespace vicon::app {
namespace {

bool isOutdated(CaseStore& store, const Config& config, const Job& job)
{
    return pipeline::isOutdated(store, config, toJson(config.get<ingest::ImportOptions>()), job.case_id, job.scan_id);
}

}  // namespace

pipeline::JobWork scanWork(CaseStore& store, const Config& config)
{
    const auto options = config.get<ingest::ImportOptions>();
    auto work = pipeline::makeScanWork(
        store, config,
        [options](const std::filesystem::path& folder, Progress& progress) {
            return ingest::loadScan(folder, options, progress);
        },
        toJson(options));
    // A new skeleton gives the markers of its scan new stations. What was corrected while the job ran is done again.
    return [&store, config, mark = config.get<MarkOptions>(), work = std::move(work)](pipeline::JobContext& context) {
        constexpr int kMostTimes = 5;
        const Job& job = context.job();
        work(context);
        for (int n = 1; n < kMostTimes && isOutdated(store, config, job); ++n)
            work(context);
        renewPlaces(store, mark, job.case_id, job.scan_id);
    };
}

void requeueOutdated(CaseStore& store, const Config& config, const std::string& case_id, const std::string& scan_id)
{
    JobQueue queue(store.database(), config.get<QueueOptions>());
    for (const Job& job :
         case_id.empty() ? queue.jobs(JobState::done) : queue.jobs(std::vector{CaseRecord{.id = case_id}}))
        if (job.state == JobState::done && (scan_id.empty() || job.scan_id == scan_id) &&
            isOutdated(store, config, job))
            queue.retry(job.case_id, job.scan_id);
}

int countOutdated(CaseStore& store, const Config& config)
{
    constexpr int kLookedAt = 1000;  // each costs a look at its files, and an archive has a million
    const auto jobs = JobQueue(store.database(), config.get<QueueOptions>()).newestDone(kLookedAt);
    return int(std::count_if(jobs.begin(), jobs.end(), [&](const Job& job) { return isOutdated(store, config, job); }));
}

}  // namespace vicon::app
