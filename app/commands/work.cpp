#include <malloc.h>

#include <cstdio>
#include <optional>

#include "../command.h"
#include "../operation_audit.h"
#include "../organs.h"
#include "../point_argument.h"
#include "../progress_line.h"
#include "../scan_work.h"
#include "../worker_processes.h"
#include "vicon/cases/corrections.h"
#include "vicon/cases/step_results.h"
#include "vicon/cases/whole_id.h"
#include "vicon/core/error.h"
#include "vicon/pipeline/worker.h"

namespace vicon::app {
namespace {

struct WorkArguments {
    bool until_idle = false;
    bool retry = false;
    bool redo_outdated = false;
    std::string case_id, scan_id, organ;
    std::vector<std::string> add, cut, drop;
    bool forget_corrections = false;
    std::string first;
    int jobs = 1;

    bool correct() const { return forget_corrections || !add.empty() || !cut.empty() || !drop.empty(); }
};

std::vector<Point3> pointsFrom(const std::vector<std::string>& texts, const char* option)
{
    std::vector<Point3> points;
    for (const std::string& text : texts)
        points.push_back(pointFrom(text, option));
    return points;
}

void correct(Context& context, CaseStore& store, const WorkArguments& arguments)
{
    if (arguments.case_id.empty())
        throw Error(ErrorCode::wrong_use, "corrections belong to one scan", "--add, --cut, --drop",
                    "name its case with --case");
    const ScanRecord scan =
        store.requireScan(requireCase(store, arguments.case_id, IdPart::whole).id, arguments.scan_id);
    const Corrections more{pointsFrom(arguments.add, "--add"), pointsFrom(arguments.cut, "--cut"),
                           pointsFrom(arguments.drop, "--drop")};
    const auto queue = context.config().get<QueueOptions>();
    if (arguments.forget_corrections)
        replaceCorrections(store, queue, scan, more);
    else
        addCorrections(store, queue, scan, more);
    requeueOutdated(store, context.config(), scan.case_id, scan.id);
}

void nameOrgan(Context& context, CaseStore& store, const WorkArguments& arguments)
{
    setOrgan(store, context.config(), arguments.organ, arguments.case_id, arguments.scan_id);
    requeueOutdated(store, context.config(), arguments.case_id);
}

/// What the pipeline says of a scan whose organ it is not sure of.
std::string warningOf(CaseStore& store, const Job& job)
{
    return resultsOf(store.steps(job.case_id, job.scan_id)).warning();
}

void retryFailed(CaseStore& store, const QueueOptions& options)
{
    JobQueue queue(store.database(), options);
    for (const Job& job : queue.jobs(JobState::failed))
        queue.retry(job.case_id, job.scan_id);
}

/// Steps take and give back hundreds of megabytes at a time. What goes back to the system comes again page by page,
/// each cleared by the kernel, which was a tenth of all the work; so it is kept while a scan is at work. One arena:
/// what one thread gave back another takes.
void keepMemory()
{
    constexpr int kNever = -1;
    ::mallopt(M_ARENA_MAX, 1);
    ::mallopt(M_MMAP_MAX, 0);
    ::mallopt(M_TRIM_THRESHOLD, kNever);
}

/// Before anything is done.
void requireNamed(CaseStore& store, const WorkArguments& arguments)
{
    if (arguments.case_id.empty() && !arguments.scan_id.empty())
        throw Error(ErrorCode::wrong_use, "a scan is one of a case", "--scan", "name its case with --case");
    if (arguments.case_id.empty() && !arguments.organ.empty())  // what waits may show any organ
        throw Error(ErrorCode::wrong_use, "an organ is said of one case", "--organ", "name the case with --case");
    if (!arguments.first.empty())
        requireCase(store, arguments.first, IdPart::whole);
    if (arguments.case_id.empty())
        return;
    const CaseRecord named = requireCase(store, arguments.case_id, IdPart::whole);
    if (!arguments.scan_id.empty())
        store.requireScan(named.id, arguments.scan_id);
}

int work(Context& context, const WorkArguments& arguments)
{
    if (arguments.jobs == 1)
        keepMemory();
    CaseStore& store = context.existingStore();
    store.database().requireReadable();  // an empty queue is no news of a store whose cases are lost
    requireNamed(store, arguments);
    const auto queue_options = context.config().get<QueueOptions>();
    if (arguments.retry)
        retryFailed(store, queue_options);
    if (!arguments.organ.empty())
        nameOrgan(context, store, arguments);
    if (arguments.correct())
        correct(context, store, arguments);
    if (arguments.redo_outdated)
        requeueOutdated(store, context.config(),
                        arguments.case_id.empty() ? "" : requireCase(store, arguments.case_id, IdPart::whole).id);
    if (!arguments.first.empty())
        JobQueue(store.database(), queue_options).putFirst(requireCase(store, arguments.first, IdPart::whole).id);
    if (arguments.jobs > 1)
        return runWorkers(context, arguments.jobs, arguments.until_idle);
    auto options = context.config().get<pipeline::WorkOptions>();
    options.until_idle = arguments.until_idle;
    std::optional<AuditedRun> audited;
    if (!arguments.until_idle)
        audited.emplace(store.place(), "work");

    ProgressLine progress("work");
    pipeline::WorkerEvents events;
    events.progress = [&](const Job& job, double fraction, const std::string& what) {
        progress.rename(job.case_id + "/" + job.scan_id);
        progress.report(fraction, what);
    };
    events.ended = [&](const Job& job, JobState state, const std::string& reason) {
        progress.clear();
        std::FILE* const told = context.json ? stderr : stdout;
        std::fprintf(told, "%s/%s: %s%s\n", job.case_id.c_str(), job.scan_id.c_str(), nameOf(state).c_str(),
                     reason.empty() ? "" : (", " + reason).c_str());
        if (const std::string warning = state == JobState::done ? warningOf(store, job) : ""; !warning.empty())
            std::fprintf(told, "  ! %s\n", warning.c_str());
        std::fflush(told);
        if (!arguments.until_idle)
            ::malloc_trim(0);  // until the next scan comes
    };
    const auto summary =
        pipeline::runWorker(store, queue_options, options, scanWork(store, context.config()), events, stopRequested());
    progress.clear();
    const int outdated = countOutdated(store, context.config());
    if (context.json)
        std::printf("{\"done\": %d, \"failed\": %d, \"waiting\": %d, \"outdated\": %d}\n", summary.done, summary.failed,
                    summary.waiting, outdated);
    else
        std::printf("%d done, %d failed, %d waiting\n", summary.done, summary.failed, summary.waiting);
    if (outdated > 0 && !context.json)
        std::printf(
            "%d finished scans are out of date (other options, another version, a lost file);"
            " 'vicon work --redo-outdated' does them again\n",
            outdated);
    const bool broken_off = arguments.until_idle && stopRequested() && summary.waiting > 0;
    return summary.failed > 0 || broken_off ? 1 : 0;
}

}  // namespace

Subcommand workCommand()
{
    return {"work", "Run the queue: resample, segment, skeleton, subdivide and potential of every waiting scan",
            [](CommandLine& command) {
                auto arguments = std::make_shared<WorkArguments>();
                command.flag("--until-idle", arguments->until_idle, "Stop when the queue is empty");
                command.option("--jobs", arguments->jobs, "So many scans at once, each by a process of its own")
                    .typeName("N")
                    .check(range(1, 1000));
                command.option("--first", arguments->first, "What waits of this case comes before what waits of others")
                    .typeName("CASE");
                command.flag("--retry", arguments->retry, "Put failed jobs back into the queue first");
                command.flag("--redo-outdated", arguments->redo_outdated,
                             "Put finished scans that other options or another version would make otherwise back "
                             "into the queue first; with --case those of one case");
                command
                    .option("--organ", arguments->organ,
                            "What the scans of --case show, or the one that --scan names: colon, airway, aorta or "
                            "stomach")
                    .typeName("NAME");
                command
                    .option("--case", arguments->case_id,
                            "The case that --organ, --redo-outdated and corrections speak of")
                    .typeName("CASE");
                command.option("--scan", arguments->scan_id, "Its scan; needed where the case has several")
                    .typeName("SCAN");
                command.option("--add", arguments->add, "The gas or fluid here (LPS mm) belongs to the colon")
                    .typeName("X,Y,Z")
                    .oneValueEach();
                command.option("--cut", arguments->cut, "Cut the lumen here; the smaller part is dropped")
                    .typeName("X,Y,Z")
                    .oneValueEach();
                command.option("--drop", arguments->drop, "The piece here does not belong to the colon")
                    .typeName("X,Y,Z")
                    .oneValueEach();
                command.flag("--forget-corrections", arguments->forget_corrections,
                             "Forget the scan's earlier additions, cuts and drops");
                return [arguments](Context& context) { return work(context, *arguments); };
            }};
}

}  // namespace vicon::app
