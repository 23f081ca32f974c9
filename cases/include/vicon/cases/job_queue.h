#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/cases/records.h"
#include "vicon/core/options.h"

namespace vicon {

///     queued --claim--> running --complete--> done
///       ^  ^               |  \--fail (attempts left: back-off)--> queued
///       |  |               |   \-fail (permanent, or the last attempt)--> failed
///       |  +--dropped------+  (lease lapsed or owner dead: counts as a failure)
///       +--retry by hand, or by import of more slices-- failed, done
enum class JobState { queued, running, done, failed };
std::string nameOf(JobState state);

/// One scan to be processed.
struct Job {
    std::string case_id;
    std::string scan_id;
    JobState state = JobState::queued;
    int attempts = 0;  ///< failures and drops since the last progress
    /// Grows with every claim. What a worker writes carries it, so that one thought dead cannot overwrite its
    /// successor.
    long long fence = 0;
    std::string owner;
    std::string step;     ///< being worked on
    double progress = 0;  ///< of the whole job, 0 to 1
    std::string reason;   ///< why it failed last
    double not_before = 0;
    double lease_until = 0;
    double memory_mb = 0;  ///< reserved on its worker's machine, MB of 10^6 bytes
};

struct QueueOptions {
    double lease_s = 60;
    int most_attempts = 5;
    int most_drops = 10;
    double first_backoff_s = 1;
    double longest_backoff_s = 600;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("queue.lease_s", lease_s, "s", "A worker that is silent for this long is taken for dead.", {1, 86400});
        v("queue.most_attempts", most_attempts, "", "After so many failures a job is failed.", {1, 1000});
        v("queue.most_drops", most_drops, "",
          "After so many workers died over a job, none of which got further than those before, it is failed.",
          {1, 1000});
        v("queue.first_backoff_s", first_backoff_s, "s", "Wait before the first retry; doubled for each further one.",
          {0, 86400});
        v("queue.longest_backoff_s", longest_backoff_s, "s", "Longest wait before a retry.", {0, 86400});
    }
};

/// Seconds since the epoch; tests give their own.
using Clock = std::function<double()>;

/// Names this process so that others on the same machine can tell whether it still lives.
std::string thisOwner();

/// The queue's table. Every method is one transaction; any number of processes may share it.
class JobQueue {
public:
    /// @param clock empty: the database's, which all workers share
    JobQueue(Database& database, QueueOptions options, Clock clock = {});

    const QueueOptions& options() const { return options_; }
    double now();

    /// Takes the job that is due: of the case that a reader opened last, else the one that has waited longest of the
    /// sender whose turn it is. First drops those whose worker is gone.
    std::optional<Job> claim(const std::string& owner);
    /// Extends the lease and shows where the job is. Throws Error{lease_lost} when another worker has the job.
    void renew(const Job& job, const std::string& step, double progress);
    /// Records a finished step, if the job is still this worker's; its failures are forgotten, for it got on.
    /// `publish` runs before, in the same transaction: nobody else can take the job meanwhile.
    void commitStep(const Job& job, const StepRecord& step, const std::function<void()>& publish = {});
    /// Takes back what steps had found. `remove` takes their files away, while nobody else can take the job. Throws
    /// Error{lease_lost} when it is not this worker's.
    void withdrawSteps(const Job& job, const std::vector<std::string>& steps, const std::function<void()>& remove);
    /// @param is_current asked while nobody else can take the job; where it does not hold, the job is queued again.
    /// Empty: it holds
    void complete(const Job& job, const std::function<bool()>& is_current = {});
    /// @param permanent trying again cannot help
    void fail(const Job& job, const std::string& reason, bool permanent);
    /// Gives a job back untouched: the worker is told to stop.
    void release(const Job& job);
    /// Gives a job back to be tried again after a while, as often as it takes: what it lacks is not its fault.
    void postpone(const Job& job, const std::string& reason, double wait_s);

    /// Puts a failed or done job back. Throws Error{not_found} when the scan has no job.
    void retry(const std::string& case_id, const std::string& scan_id);

    std::optional<Job> find(const std::string& case_id, const std::string& scan_id);
    /// The same, after whoever is just changing the job has done so.
    std::optional<Job> findSettled(const std::string& case_id, const std::string& scan_id);
    std::vector<Job> jobs();
    std::vector<Job> jobs(JobState state);
    std::vector<Job> jobs(const std::vector<CaseRecord>& cases);
    /// Of the jobs that are done, those of the scans that came last.
    std::vector<Job> newestDone(int most);
    int count(JobState state);
    /// Jobs that run, or on which a worker has been since then ("2026-11-21T08:15:30Z").
    std::vector<Job> workedOnSince(const std::string& utc);
    /// How long the job that waits longest for its retry has been due; 0 where none is.
    double oldestWait_s();
    /// A reader opened the case: what of it waits comes before what waits of others.
    void putFirst(const std::string& case_id);
    /// Sets memory aside for a job until it ends. False, and nothing is set aside, when all jobs on its worker's
    /// machine would then have more than `most_mb` together; a job that is alone there always gets it.
    bool reserveMemory(const Job& job, double mb, double most_mb);
    /// When the next queued job is due or the next lease lapses; nothing when no job waits or runs.
    std::optional<double> nextDue();

private:
    double nowIn(soci::session& sql) const;
    void limitTimes(soci::session& sql);
    void dropLost(soci::session& sql);
    void settle(soci::session& sql, const Job& job, JobState state, double not_before, const std::string& reason,
                int attempts);
    void requireFence(soci::session& sql, const Job& job);
    std::vector<Job> select(const std::string& where);
    std::optional<double> earliest(const std::string& column, const std::string& where);

    Database& database_;
    QueueOptions options_;
    Clock clock_;
};

}  // namespace vicon
