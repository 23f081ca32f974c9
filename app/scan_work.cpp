#include "scan_work.h"

#include <algorithm>

#include "vicon/cases/placing.h"
#include "vicon/core/error.h"
#include "vicon/ingest/load_scan.h"

namespace vicon::app {
namespace {

bool isOutdated(CaseStore& store, const Config& config, const Job& job)
{
    return pipeline::isOutdated(store, config, toJson(config.get<ingest::ImportOptions>()), job.case_id, job.scan_id);
}

/// Where that cannot be told the job is done again, and says why.
bool isCurrentStill(CaseStore& store, const Config& config, const Job& job)
{
    try {
        return !isOutdated(store, config, job);
    } catch (const Error& e) {
        if (e.code() == ErrorCode::database)
            throw;
        return false;
    }
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
        bool is_current = false;
        for (int n = 0; n < kMostTimes && !is_current; ++n) {
            work(context);
            is_current = !isOutdated(store, config, job);
        }
        renewPlaces(store, mark, job.case_id, job.scan_id);
        if (is_current)  // what never is must not be done for ever
            context.completeIf([&store, &config, job] { return isCurrentStill(store, config, job); });
    };
}

void requeueOutdated(CaseStore& store, const Config& config, const std::string& case_id, const std::string& scan_id)
{
    JobQueue queue(store.database(), config.get<QueueOptions>());
    const auto requeue = [&](const Job& job) {
        if (job.state == JobState::done && isOutdated(store, config, job))
            queue.retry(job.case_id, job.scan_id);
    };
    if (case_id.empty()) {
        std::ranges::for_each(queue.jobs(JobState::done), requeue);
        return;
    }
    // One that is just ending has seen what was changed, or is done when it is looked at here.
    for (const Job& seen : queue.jobs(std::vector{CaseRecord{.id = case_id}}))
        if (scan_id.empty() || seen.scan_id == scan_id)
            if (const auto job = queue.findSettled(seen.case_id, seen.scan_id))
                requeue(*job);
}

int countOutdated(CaseStore& store, const Config& config)
{
    constexpr int kLookedAt = 1000;  // each costs a look at its files, and an archive has a million
    const auto jobs = JobQueue(store.database(), config.get<QueueOptions>()).newestDone(kLookedAt);
    return int(std::count_if(jobs.begin(), jobs.end(), [&](const Job& job) { return isOutdated(store, config, job); }));
}

}  // namespace vicon::app
