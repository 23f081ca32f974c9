#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>

#include "vicon/cases/case_store.h"
#include "vicon/cases/job_queue.h"
#include "vicon/core/progress.h"

namespace vicon::pipeline {

/// What the work on one job may use: progress that also renews the lease and never goes back, and the way to record a
/// finished step.
class JobContext : public Progress {
public:
    virtual const Job& job() const = 0;
    /// Names the step that report() speaks of, and the part of the job it is: [from, to] of 0 to 1.
    virtual void enterStep(const std::string& step, double from, double to) = 0;
    /// @param publish puts the step's files in their place; runs while nobody else can take the job
    virtual void commitStep(const StepRecord& step, const std::function<void()>& publish = {}) = 0;
    /// Takes back what steps had found. @param remove takes their files away, while nobody else can take the job
    virtual void withdrawSteps(const std::vector<std::string>& steps, const std::function<void()>& remove) = 0;
    /// Sets memory aside until the job ends; where the machine's other jobs take it, the job goes back into the queue
    /// and waits.
    virtual void reserveMemory(double mb, double most_mb) = 0;
    /// Asked at the job's end, while nobody else can take it: where it does not hold, the job goes back into the queue.
    virtual void completeIf(std::function<bool()> is_current) = 0;
};

/// The work itself. Throws Error{cancelled} when told to stop, anything else to fail.
using JobWork = std::function<void(JobContext&)>;

/// Watches a worker: told of every report, and of every job's end; one call at a time, from any thread.
struct WorkerEvents {
    std::function<void(const Job&, double fraction, const std::string& what)> progress = [](auto&&...) {};
    std::function<void(const Job&, JobState, const std::string& reason)> ended = [](auto&&...) {};
    /// The store or its database cannot be used; the worker tries again.
    std::function<void(const std::string& what)> trouble = [](auto&&...) {};
};

struct WorkOptions {
    bool until_idle = false;
    double longest_wait_s = 30;
    double machine_memory_mb = 0;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("work.longest_wait_s", longest_wait_s, "s",
          "How long 'work --until-idle' waits in total for jobs that are held back after a failure.", {0, 86400});
        v("work.machine_memory_mb", machine_memory_mb, "MB",
          "What all workers of a machine together may take; 0: four fifths of what it has.", {0, 1e8});
    }
};

struct WorkSummary {
    int done = 0;
    int failed = 0;   ///< ended failed in this run, also those that killed their workers
    int waiting = 0;  ///< still held back when the wait was over
};

/// Claims jobs and does them, one at a time, until the queue is idle or `stop` is set. A second connection to the
/// database renews the lease while the work runs. A job that fails because the disk is full waits for space. Where the
/// database refuses, it goes on when it can again, or throws when it is to stop at an idle queue. Throws Error{store}
/// where the store is gone.
WorkSummary runWorker(CaseStore& store, const QueueOptions& queue_options, const WorkOptions& options,
                      const JobWork& work, const WorkerEvents& events, const std::atomic<bool>& stop);

}  // namespace vicon::pipeline
