#include <cstdio>

#include "../command.h"
#include "../progress_line.h"
#include "../scan_work.h"
#include "vicon/core/error.h"
#include "vicon/pipeline/worker.h"

namespace vicon::app {
namespace {

struct WorkArguments {
    bool until_idle = false;
    bool retry = false;
};

void retryFailed(CaseStore& store, const pipeline::QueueOptions& options)
{
    pipeline::JobQueue queue(store.database(), options);
    for (const pipeline::Job& job : queue.jobs())
        if (job.state == pipeline::JobState::failed)
            queue.retry(job.case_id, job.scan_id);
}

int work(Context& context, const WorkArguments& arguments)
{
    CaseStore& store = context.existingStore();
    const auto queue_options = context.config().get<pipeline::QueueOptions>();
    if (arguments.retry)
        retryFailed(store, queue_options);
    requeueOutdated(store, context.config());
    auto options = context.config().get<pipeline::WorkOptions>();
    options.until_idle = arguments.until_idle;

    ProgressLine progress("work");
    pipeline::WorkerEvents events;
    events.progress = [&](const pipeline::Job& job, double fraction, const std::string& what) {
        progress.rename(job.case_id + "/" + job.scan_id);
        progress.report(fraction, what);
    };
    events.ended = [&](const pipeline::Job& job, pipeline::JobState state, const std::string& reason) {
        progress.clear();
        std::printf("%s/%s: %s%s\n", job.case_id.c_str(), job.scan_id.c_str(), pipeline::nameOf(state).c_str(),
                    reason.empty() ? "" : (", " + reason).c_str());
        std::fflush(stdout);
    };
    const auto summary =
        pipeline::runWorker(store, queue_options, options, scanWork(store, context.config()), events, stopRequested());
    progress.clear();
    if (context.json)
        std::printf("{\"done\": %d, \"failed\": %d, \"waiting\": %d}\n", summary.done, summary.failed, summary.waiting);
    else
        std::printf("%d done, %d failed, %d waiting\n", summary.done, summary.failed, summary.waiting);
    return summary.failed > 0 ? 1 : 0;
}

}  // namespace

Subcommand workCommand()
{
    return {"work", "Run the queue: resample, segment, skeleton, subdivide and potential of every waiting scan",
            [](CLI::App& command) {
                auto arguments = std::make_shared<WorkArguments>();
                command.add_flag("--until-idle", arguments->until_idle, "Stop when the queue is empty");
                command.add_flag("--retry", arguments->retry, "Put failed jobs back into the queue first");
                return [arguments](Context& context) { return work(context, *arguments); };
            }};
}

}  // namespace vicon::app
