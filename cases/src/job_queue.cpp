#include "vicon/cases/job_queue.h"

#include <soci/soci.h>

#include <algorithm>
#include <cmath>

#include "job_owner.h"
#include "job_rows.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace vicon {
namespace {

constexpr JobState kStates[] = {JobState::queued, JobState::running, JobState::done, JobState::failed};

JobState stateFrom(const std::string& name)
{
    for (const JobState state : kStates)
        if (nameOf(state) == name)
            return state;
    throw Error(ErrorCode::database, "unknown job state '" + name + "'");
}

Job jobFrom(const soci::row& row)
{
    Job job;
    job.case_id = row.get<std::string>("case_id");
    job.scan_id = row.get<std::string>("scan_id");
    job.state = stateFrom(row.get<std::string>("state"));
    job.attempts = row.get<int>("attempts");
    job.fence = row.get<int>("fence");
    job.owner = row.get<std::string>("owner");
    job.step = row.get<std::string>("step");
    job.progress = row.get<double>("progress");
    job.reason = row.get<std::string>("reason");
    job.not_before = row.get<double>("not_before");
    job.lease_until = row.get<double>("lease_until");
    return job;
}

std::vector<Job> collect(const soci::rowset<soci::row>& rows)
{
    std::vector<Job> jobs;
    for (const soci::row& row : rows)
        jobs.push_back(jobFrom(row));
    return jobs;
}

/// Whether the job was further when its worker stopped than it was whenever one stopped before.
bool gotFurther(soci::session& sql, const Job& job)
{
    constexpr double kPerMille = 1000;
    const std::string name = furthestName(job.case_id, job.scan_id);
    const int now = int(job.progress * kPerMille);
    int before = 0;
    sql << "SELECT COALESCE(MAX(value), 0) FROM counters WHERE name = :name", soci::use(name), soci::into(before);
    if (now <= before)
        return false;
    sql << "INSERT INTO counters (name, value) VALUES (:name, :value)"
           " ON CONFLICT (name) DO UPDATE SET value = excluded.value",
        soci::use(name), soci::use(now);
    return true;
}

}  // namespace

std::string nameOf(JobState state)
{
    switch (state) {
        case JobState::queued:
            return "queued";
        case JobState::running:
            return "running";
        case JobState::done:
            return "done";
        case JobState::failed:
            return "failed";
    }
    return "failed";
}

JobQueue::JobQueue(Database& database, QueueOptions options, Clock clock)
    : database_(database), options_(options), clock_(std::move(clock))
{
}

double JobQueue::nowIn(soci::session& sql) const
{
    return clock_ ? clock_() : secondsIn(sql);
}

double JobQueue::now()
{
    return nowIn(database_.session());
}

std::optional<Job> JobQueue::claim(const std::string& owner)
{
    std::optional<Job> claimed;
    database_.write([&](soci::session& sql) {
        capTimes(sql);
        dropLost(sql);
        const double now = nowIn(sql), lease_until = now + options_.lease_s;
        const std::string changed = nowUtc();
        const soci::rowset<soci::row> rows =
            (sql.prepare
                 << "UPDATE jobs SET state = 'running', owner = :owner, lease_until = :until, fence = fence + 1,"
                    " changed = :changed WHERE rowid = (SELECT rowid FROM jobs WHERE state = 'queued'"
                    " AND not_before <= :now ORDER BY not_before, rowid LIMIT 1) RETURNING *",
             soci::use(owner), soci::use(lease_until), soci::use(changed), soci::use(now));
        const auto jobs = collect(rows);
        if (!jobs.empty())
            claimed = jobs.front();
    });
    return claimed;
}

/// A clock that ran ahead leaves times that no lease and no back-off can have; they must not hide a job.
void JobQueue::capTimes(soci::session& sql)
{
    const double latest_lease = nowIn(sql) + options_.lease_s, latest_start = nowIn(sql) + options_.longest_backoff_s;
    sql << "UPDATE jobs SET lease_until = :l WHERE state = 'running' AND lease_until > :limit", soci::use(latest_lease),
        soci::use(latest_lease);
    sql << "UPDATE jobs SET not_before = :n WHERE state = 'queued' AND not_before > :limit", soci::use(latest_start),
        soci::use(latest_start);
}

void JobQueue::dropLost(soci::session& sql)
{
    const double now = nowIn(sql);
    const soci::rowset<soci::row> rows = (sql.prepare << "SELECT * FROM jobs WHERE state = 'running'");
    for (Job& job : collect(rows)) {
        if (job.lease_until > now && !ownerIsGone(job.owner))
            continue;
        const int attempts = gotFurther(sql, job) ? 1 : job.attempts + 1;
        const bool last = attempts >= options_.most_drops;
        settle(sql, job, last ? JobState::failed : JobState::queued, now,
               "the worker stopped without a word" + (job.step.empty() ? "" : " in step " + job.step), attempts);
    }
}

void JobQueue::requireFence(soci::session& sql, const Job& job)
{
    int mine = 0;
    sql << "SELECT COUNT(*) FROM jobs WHERE case_id = :c AND scan_id = :s AND state = 'running' AND fence = :f",
        soci::use(job.case_id), soci::use(job.scan_id), soci::use(job.fence), soci::into(mine);
    if (mine == 0)
        throw Error(ErrorCode::lease_lost, "another worker has this scan now", job.case_id + "/" + job.scan_id);
}

void JobQueue::renew(const Job& job, const std::string& step, double progress)
{
    database_.write([&](soci::session& sql) {
        requireFence(sql, job);
        const double lease_until = nowIn(sql) + options_.lease_s;
        sql << "UPDATE jobs SET lease_until = :u, step = :step, progress = :p WHERE case_id = :c AND scan_id = :s",
            soci::use(lease_until), soci::use(step), soci::use(progress), soci::use(job.case_id),
            soci::use(job.scan_id);
    });
}

void JobQueue::underFence(const Job& job, const std::function<void()>& action)
{
    database_.write([&](soci::session& sql) {
        requireFence(sql, job);
        action();
    });
}

void JobQueue::commitStep(const Job& job, const StepRecord& step, const std::function<void()>& publish)
{
    const std::string parameters = step.parameters.dump(), result = step.result.dump();
    database_.write([&](soci::session& sql) {
        requireFence(sql, job);
        if (publish)
            publish();
        const double lease_until = nowIn(sql) + options_.lease_s;
        sql << "INSERT INTO steps (case_id, scan_id, step, version, digest, parameters, result, seconds, finished)"
               " VALUES (:c, :s, :step, :v, :d, :p, :r, :sec, :f) ON CONFLICT (case_id, scan_id, step) DO UPDATE SET"
               " version = excluded.version, digest = excluded.digest, parameters = excluded.parameters,"
               " result = excluded.result, seconds = excluded.seconds, finished = excluded.finished",
            soci::use(job.case_id), soci::use(job.scan_id), soci::use(step.step), soci::use(step.version),
            soci::use(step.digest), soci::use(parameters), soci::use(result), soci::use(step.seconds),
            soci::use(step.finished);
        sql << "UPDATE jobs SET attempts = 0, lease_until = :u WHERE case_id = :c AND scan_id = :s",
            soci::use(lease_until), soci::use(job.case_id), soci::use(job.scan_id);
    });
}

void JobQueue::settle(soci::session& sql, const Job& job, JobState state, double not_before, const std::string& reason,
                      int attempts)
{
    const std::string name = nameOf(state), changed = nowUtc();
    sql << "UPDATE jobs SET state = :state, not_before = :nb, reason = :reason, attempts = :a, owner = '',"
           " lease_until = 0, changed = :ch WHERE case_id = :c AND scan_id = :s",
        soci::use(name), soci::use(not_before), soci::use(reason), soci::use(attempts), soci::use(changed),
        soci::use(job.case_id), soci::use(job.scan_id);
}

void JobQueue::complete(const Job& job)
{
    database_.write([&](soci::session& sql) {
        requireFence(sql, job);
        settle(sql, job, JobState::done, 0, "", 0);
    });
}

void JobQueue::fail(const Job& job, const std::string& reason, bool permanent)
{
    database_.write([&](soci::session& sql) {
        requireFence(sql, job);
        int attempts = 0;
        sql << "SELECT attempts FROM jobs WHERE case_id = :c AND scan_id = :s", soci::use(job.case_id),
            soci::use(job.scan_id), soci::into(attempts);
        ++attempts;
        if (permanent || attempts >= options_.most_attempts) {
            settle(sql, job, JobState::failed, 0, reason, attempts);
            return;
        }
        const double wait = std::min(options_.longest_backoff_s, options_.first_backoff_s * std::pow(2, attempts - 1));
        settle(sql, job, JobState::queued, nowIn(sql) + wait, reason, attempts);
    });
}

void JobQueue::release(const Job& job)
{
    database_.write([&](soci::session& sql) {
        requireFence(sql, job);
        settle(sql, job, JobState::queued, nowIn(sql), "", job.attempts);
    });
}

void JobQueue::postpone(const Job& job, const std::string& reason, double wait_s)
{
    database_.write([&](soci::session& sql) {
        requireFence(sql, job);
        settle(sql, job, JobState::queued, nowIn(sql) + wait_s, reason, job.attempts);
    });
}

void JobQueue::retry(const std::string& case_id, const std::string& scan_id)
{
    if (!find(case_id, scan_id))
        throw Error(ErrorCode::not_found, "the scan has no job", case_id + "/" + scan_id);
    database_.write([&](soci::session& sql) { enqueueJob(sql, case_id, scan_id); });
}

std::optional<Job> JobQueue::find(const std::string& case_id, const std::string& scan_id)
{
    const soci::rowset<soci::row> rows =
        (database_.session().prepare << "SELECT * FROM jobs WHERE case_id = :c AND scan_id = :s", soci::use(case_id),
         soci::use(scan_id));
    const auto found = collect(rows);
    return found.empty() ? std::nullopt : std::optional(found.front());
}

std::vector<Job> JobQueue::jobs()
{
    const soci::rowset<soci::row> rows = (database_.session().prepare << "SELECT * FROM jobs ORDER BY rowid");
    return collect(rows);
}

std::optional<double> JobQueue::nextDue()
{
    std::optional<double> due;
    for (const Job& job : jobs()) {
        const bool waiting = job.state == JobState::queued, running = job.state == JobState::running;
        if (waiting || running)
            due = std::min(due.value_or(1e300), waiting ? job.not_before : job.lease_until);
    }
    return due;
}

}  // namespace vicon
