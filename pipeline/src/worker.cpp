#include "vicon/pipeline/worker.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <system_error>
#include <thread>

#include "vicon/cases/store_presence.h"
#include "vicon/core/error.h"
#include "vicon/core/printable.h"

namespace vicon::pipeline {
namespace {

constexpr double kIdlePoll_s = 0.5;
constexpr double kRoomWait_s = 2;
constexpr double kSpaceWait_s = 30;  // until a full disk is looked at again
constexpr double kFirstTroubleWait_s = 1, kLongestTroubleWait_s = 60;
constexpr const char* kNoMemory =
    "not enough memory, or too many threads; close other programs, then 'vicon work --retry'";

/// Renews a job's lease from a thread and a connection of its own until it is destroyed or the lease is lost.
class Heartbeat {
public:
    Heartbeat(const std::string& database, const QueueOptions& options, const Job& job)
        : thread_([this, database, options, job] { run(database, options, job); })
    {
    }
    ~Heartbeat()
    {
        {
            const std::lock_guard lock(mutex_);
            over_ = true;
        }
        changed_.notify_all();
        thread_.join();
    }
    Heartbeat(const Heartbeat&) = delete;
    Heartbeat& operator=(const Heartbeat&) = delete;

    void show(const std::string& step, double progress)
    {
        const std::lock_guard lock(mutex_);
        step_ = step;
        progress_ = progress;
    }
    bool leaseLost() const { return lost_; }

private:
    void run(const std::string& where, const QueueOptions& options, const Job& job)
    {
        const auto interval = std::chrono::duration<double>(std::min(options.lease_s / 3, 2.0));
        std::unique_ptr<Database> database;
        std::unique_lock lock(mutex_);
        while (!changed_.wait_for(lock, interval, [this] { return over_; })) {
            const std::string step = step_;
            const double progress = progress_;
            lock.unlock();
            try {
                if (!database)
                    database = std::make_unique<Database>(where, false);
                JobQueue(*database, options).renew(job, step, progress);
            } catch (const Error& e) {
                if (e.code() == ErrorCode::lease_lost)
                    lost_ = true;
                // Anything else may pass (a busy disk, a server that is started anew); if it does not, the lease
                // lapses and the fence keeps order.
            } catch (const std::exception&) {
                lost_ = true;
            }
            lock.lock();
        }
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    bool over_ = false;
    std::string step_;
    double progress_ = 0;
    std::atomic<bool> lost_ = false;
    std::thread thread_;  // last: it uses everything above
};

/// Others of this machine have the memory.
struct NoRoom {};

class Context : public JobContext {
public:
    Context(const Job& job, JobQueue& queue, Heartbeat& heartbeat, const WorkerEvents& events,
            const std::atomic<bool>& stop)
        : job_(job), queue_(queue), heartbeat_(heartbeat), events_(events), stop_(stop)
    {
    }
    const Job& job() const override { return job_; }
    void enterStep(const std::string& step, double from, double to) override
    {
        double whole = 0;
        {
            const std::lock_guard lock(mutex_);
            step_ = step;
            from_ = from;
            to_ = to;
            whole = whole_ = std::max(whole_, from);
        }
        queue_.renew(job_, step, whole);  // a step that kills its worker is known by name
        const std::lock_guard lock(mutex_);
        tell(whole_, "");
    }
    void report(double fraction, std::string_view what) override
    {
        const std::lock_guard lock(mutex_);
        whole_ = std::max(whole_, from_ + (to_ - from_) * std::clamp(fraction, 0.0, 1.0));
        tell(whole_, what);
    }
    bool cancelled() const override { return stop_ || heartbeat_.leaseLost(); }
    void commitStep(const StepRecord& step, const std::function<void()>& publish) override
    {
        queue_.commitStep(job_, step, publish);
    }
    void withdrawSteps(const std::vector<std::string>& steps, const std::function<void()>& remove) override
    {
        queue_.withdrawSteps(job_, steps, remove);
    }
    void reserveMemory(double mb, double most_mb) override
    {
        if (!queue_.reserveMemory(job_, mb, most_mb))
            throw NoRoom();
    }
    void completeIf(std::function<bool()> is_current) override { is_current_ = std::move(is_current); }
    const std::function<bool()>& isCurrent() const { return is_current_; }

private:
    void tell(double whole, std::string_view what)
    {
        heartbeat_.show(step_, whole);
        events_.progress(job_, whole, what.empty() ? step_ : step_ + ": " + std::string(what));
    }

    const Job& job_;
    JobQueue& queue_;
    Heartbeat& heartbeat_;
    const WorkerEvents& events_;
    const std::atomic<bool>& stop_;
    std::function<bool()> is_current_;
    std::mutex mutex_;  // of all below, and of the events
    std::string step_;
    double from_ = 0, to_ = 1, whole_ = 0;
};

/// Whether trying again could end otherwise.
bool isPermanent(ErrorCode code)
{
    switch (code) {
        case ErrorCode::store:
        case ErrorCode::database:
        case ErrorCode::no_memory:
        case ErrorCode::internal:
            return false;
        default:
            return true;
    }
}

/// Whether the disk had no room: somebody must make some, and then the work goes on.
bool isFullDisk(const Error& e)
{
    const std::string what = e.what();
    const auto says = [&](const char* words) { return what.find(words) != std::string::npos; };
    return (e.code() == ErrorCode::store || e.code() == ErrorCode::database) &&
           (says(std::strerror(ENOSPC)) || says(std::strerror(EDQUOT)) || says("disk is full"));
}

struct Outcome {
    enum class Kind { done, failed, no_space, no_room, stopped, lost } kind = Kind::done;
    std::string reason;
    bool permanent = false;
};

Outcome doWork(const JobWork& work, Context& context)
{
    try {
        work(context);
        return {};
    } catch (const Error& e) {
        if (e.code() == ErrorCode::lease_lost)
            return {Outcome::Kind::lost, e.what()};
        if (e.code() == ErrorCode::cancelled)
            return {Outcome::Kind::stopped, e.what()};
        if (isFullDisk(e))
            return {Outcome::Kind::no_space, e.what()};
        return {Outcome::Kind::failed, e.what(), isPermanent(e.code())};
    } catch (const NoRoom&) {
        return {Outcome::Kind::no_room};
    } catch (const std::bad_alloc&) {
        return {Outcome::Kind::failed, kNoMemory};
    } catch (const std::system_error& e) {
        const bool no_thread = e.code() == std::errc::resource_unavailable_try_again;
        return {Outcome::Kind::failed, no_thread ? kNoMemory : e.what()};
    } catch (const std::exception& e) {  // a library's words may hold what came from outside
        return {Outcome::Kind::failed, printable(e.what())};
    }
}

/// Does one job to its end and says how it ended; nothing when it is another worker's now, or gone with its case.
std::optional<JobState> doJob(const Job& job, JobQueue& queue, const std::string& database, const JobWork& work,
                              const WorkerEvents& events, const std::atomic<bool>& stop)
{
    Outcome outcome;
    std::function<bool()> is_current;
    {
        Heartbeat heartbeat(database, queue.options(), job);
        Context context(job, queue, heartbeat, events, stop);
        outcome = doWork(work, context);
        is_current = context.isCurrent();
        if (outcome.kind == Outcome::Kind::stopped && heartbeat.leaseLost())
            outcome.kind = Outcome::Kind::lost;
    }
    try {
        switch (outcome.kind) {
            case Outcome::Kind::done:
                queue.complete(job, is_current);
                break;
            case Outcome::Kind::failed:
                queue.fail(job, outcome.reason, outcome.permanent);
                break;
            case Outcome::Kind::no_space:
                queue.postpone(job, "waits for space: " + outcome.reason, kSpaceWait_s);
                break;
            case Outcome::Kind::no_room:
                queue.postpone(job, "waits for memory that other scans take", kRoomWait_s);
                return std::nullopt;
            case Outcome::Kind::stopped:
                queue.release(job);
                break;
            case Outcome::Kind::lost:
                return std::nullopt;
        }
    } catch (const Error& e) {
        if (e.code() == ErrorCode::lease_lost)
            return std::nullopt;
        throw;
    }
    const auto ended = queue.find(job.case_id, job.scan_id);
    if (!ended)  // its case was deleted since
        return std::nullopt;
    events.ended(job, ended->state, outcome.reason);
    return ended->state;
}

bool othersWork(JobQueue& queue)
{
    return queue.count(JobState::running) > 0;
}

/// Each with its fence: one that fails again is another one.
std::set<std::string> failedJobs(JobQueue& queue)
{
    std::set<std::string> failed;
    for (const Job& job : queue.jobs(JobState::failed))
        failed.insert(job.case_id + "/" + job.scan_id + " " + std::to_string(job.fence));
    return failed;
}

void sleepFor(double seconds, const std::atomic<bool>& stop)
{
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (!stop && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

}  // namespace

WorkSummary runWorker(CaseStore& store, const QueueOptions& queue_options, const WorkOptions& options,
                      const JobWork& work, const WorkerEvents& events, const std::atomic<bool>& stop)
{
    JobQueue queue(store.database(), queue_options);
    const std::string owner = thisOwner();
    std::optional<std::set<std::string>> failed_before;
    WorkSummary summary;
    double waited_s = 0, trouble_wait_s = kFirstTroubleWait_s;
    while (!stop) {
        requireThere(store.place());
        try {
            if (!failed_before)
                failed_before = failedJobs(queue);
            if (const auto job = queue.claim(owner)) {
                const auto end = doJob(*job, queue, store.database().where(), work, events, stop);
                summary.done += end == JobState::done;
                trouble_wait_s = kFirstTroubleWait_s;
                continue;
            }
            const auto due = queue.nextDue();
            if (options.until_idle && (!due || waited_s >= options.longest_wait_s))
                break;
            const double pause = std::clamp(due ? *due - queue.now() : kIdlePoll_s, 0.02, kIdlePoll_s);
            sleepFor(pause, stop);
            if (!othersWork(queue))
                waited_s += pause;
        } catch (const std::exception& e) {  // the database; a job's own troubles are its outcome
            if (options.until_idle)
                throw;
            events.trouble(std::string("the queue cannot be used, the worker tries again: ") + e.what());
            sleepFor(trouble_wait_s, stop);
            trouble_wait_s = std::min(2 * trouble_wait_s, kLongestTroubleWait_s);
        }
    }
    summary.waiting = queue.count(JobState::queued);
    for (const std::string& job : failedJobs(queue))
        summary.failed += failed_before && failed_before->contains(job) ? 0 : 1;
    return summary;
}

}  // namespace vicon::pipeline
