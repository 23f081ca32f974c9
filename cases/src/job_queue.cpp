#include "vicon/cases/job_queue.h"

#include <soci/soci.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "case_rows.h"
#include "database_engine.h"
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
    job.memory_mb = row.get<double>("memory_mb");
    return job;
}

std::vector<Job> jobsOf(const soci::rowset<soci::row>& rows)
{
    std::vector<Job> jobs;
    for (const soci::row& row : rows)
        jobs.push_back(jobFrom(row));
    return jobs;
}

/// Others claim at the same time where the database lets them: each takes a row that nobody has in hand.
std::string skippingLocked(soci::session& sql)
{
    return isPostgresql(sql) ? " FOR UPDATE SKIP LOCKED" : "";
}

/// Keeps the job's row from all others until the transaction ends, if it is still as it was seen.
bool hold(soci::session& sql, const Job& job)
{
    long long fence = 0;
    sql << "UPDATE jobs SET fence = fence WHERE case_id = :c AND scan_id = :s AND state = 'running' AND fence = :f"
           " AND owner = :o RETURNING fence",
        soci::use(job.case_id), soci::use(job.scan_id), soci::use(job.fence), soci::use(job.owner), soci::into(fence);
    return sql.got_data();
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
    double now = 0;
    database_.read([&](soci::session& sql) { now = nowIn(sql); });
    return now;
}

std::optional<Job> JobQueue::claim(const std::string& owner)
{
    std::optional<Job> claimed;
    database_.writeRows([&](soci::session& sql) {
        claimed.reset();  // what an earlier run of this took was not saved
        limitTimes(sql);
        dropLost(sql);
        const double now = nowIn(sql), lease_until = now + options_.lease_s;
        const std::string changed = nowUtc();
        const soci::rowset<soci::row> rows =
            (sql.prepare
                 << "UPDATE jobs SET state = 'running', owner = :owner, lease_until = :until, fence = fence + 1,"
                    " changed = :changed WHERE (case_id, scan_id) = (SELECT case_id, scan_id FROM jobs"
                    " WHERE state = 'queued' AND not_before <= :now ORDER BY opened DESC, turn, queued, rowid LIMIT 1" +
                        skippingLocked(sql) + ") RETURNING *",
             soci::use(owner), soci::use(lease_until), soci::use(changed), soci::use(now));
        const auto jobs = jobsOf(rows);
        if (!jobs.empty())
            claimed = jobs.front();
    });
    return claimed;
}

/// A clock that ran ahead leaves times that no lease and no back-off can have; they must not hide a job.
void JobQueue::limitTimes(soci::session& sql)
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
    std::vector<Job> running = jobsOf((sql.prepare << "SELECT * FROM jobs WHERE state = 'running'"));
    // In one order for all: two that drop the same jobs must not wait for each other. Sorted here: SQLite would walk
    // through all jobs for it.
    std::ranges::sort(running, {}, [](const Job& job) { return std::tie(job.case_id, job.scan_id); });
    for (Job& job : running) {
        const auto isLost = [&](const Job& seen) { return seen.lease_until <= now || ownerIsGone(seen.owner); };
        if (!isLost(job) || !hold(sql, job) || !isLost(*find(job.case_id, job.scan_id)))
            continue;  // others may have renewed or dropped it since it was read
        const int attempts = gotFurther(sql, job) ? 1 : job.attempts + 1;
        const bool last = attempts >= options_.most_drops;
        settle(sql, job, last ? JobState::failed : JobState::queued, now,
               "the worker stopped without a word" + (job.step.empty() ? "" : " in step " + job.step), attempts);
    }
}

void JobQueue::requireFence(soci::session& sql, const Job& job)
{
    if (!hold(sql, job))
        throw Error(ErrorCode::lease_lost, "another worker has this scan now", job.case_id + "/" + job.scan_id);
}

void JobQueue::renew(const Job& job, const std::string& step, double progress)
{
    database_.writeRows([&](soci::session& sql) {
        requireFence(sql, job);
        const double lease_until = nowIn(sql) + options_.lease_s;
        sql << "UPDATE jobs SET lease_until = :u, step = :step, progress = :p WHERE case_id = :c AND scan_id = :s",
            soci::use(lease_until), soci::use(step), soci::use(progress), soci::use(job.case_id),
            soci::use(job.scan_id);
    });
}

void JobQueue::withdrawSteps(const Job& job, const std::vector<std::string>& steps, const std::function<void()>& remove)
{
    database_.writeRows([&](soci::session& sql) {
        requireFence(sql, job);
        for (const std::string& step : steps)
            sql << "DELETE FROM steps WHERE case_id = :c AND scan_id = :s AND step = :step", soci::use(job.case_id),
                soci::use(job.scan_id), soci::use(step);
        remove();
    });
}

void JobQueue::commitStep(const Job& job, const StepRecord& step, const std::function<void()>& publish)
{
    const std::string parameters = step.parameters.dump(), result = step.result.dump();
    database_.writeRows([&](soci::session& sql) {
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
           " lease_until = 0, memory_mb = 0, changed = :ch WHERE case_id = :c AND scan_id = :s",
        soci::use(name), soci::use(not_before), soci::use(reason), soci::use(attempts), soci::use(changed),
        soci::use(job.case_id), soci::use(job.scan_id);
}

void JobQueue::complete(const Job& job, const std::function<bool()>& is_current)
{
    database_.writeRows([&](soci::session& sql) {
        requireFence(sql, job);
        const bool done = !is_current || is_current();
        settle(sql, job, done ? JobState::done : JobState::queued, 0, "", 0);
    });
}

void JobQueue::fail(const Job& job, const std::string& reason, bool permanent)
{
    database_.writeRows([&](soci::session& sql) {
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
    database_.writeRows([&](soci::session& sql) {
        requireFence(sql, job);
        settle(sql, job, JobState::queued, nowIn(sql), "", job.attempts);
    });
}

void JobQueue::postpone(const Job& job, const std::string& reason, double wait_s)
{
    database_.writeRows([&](soci::session& sql) {
        requireFence(sql, job);
        settle(sql, job, JobState::queued, nowIn(sql) + wait_s, reason, job.attempts);
    });
}

void JobQueue::retry(const std::string& case_id, const std::string& scan_id)
{
    if (!find(case_id, scan_id))
        throw Error(ErrorCode::not_found, "the scan has no job", case_id + "/" + scan_id);
    database_.writeRows([&](soci::session& sql) { enqueueJob(sql, case_id, scan_id); });
}

std::optional<Job> JobQueue::find(const std::string& case_id, const std::string& scan_id)
{
    std::optional<Job> found;
    database_.read([&](soci::session& sql) {
        const auto jobs = jobsOf((sql.prepare << "SELECT * FROM jobs WHERE case_id = :c AND scan_id = :s",
                                  soci::use(case_id), soci::use(scan_id)));
        found = jobs.empty() ? std::nullopt : std::optional(jobs.front());
    });
    return found;
}

std::optional<Job> JobQueue::findSettled(const std::string& case_id, const std::string& scan_id)
{
    std::optional<Job> found;
    database_.writeRows([&](soci::session& sql) {
        sql << "UPDATE jobs SET fence = fence WHERE case_id = :c AND scan_id = :s", soci::use(case_id),
            soci::use(scan_id);
        found = find(case_id, scan_id);
    });
    return found;
}

std::vector<Job> JobQueue::select(const std::string& where)
{
    std::vector<Job> jobs;
    database_.read([&](soci::session& sql) { jobs = jobsOf((sql.prepare << "SELECT * FROM jobs " + where)); });
    return jobs;
}

std::vector<Job> JobQueue::jobs()
{
    return select("ORDER BY rowid");
}

/// By the state's own index: without the sign SQLite would walk through all jobs, which have their order.
std::vector<Job> JobQueue::jobs(JobState state)
{
    return select("WHERE state = '" + nameOf(state) + "' ORDER BY +rowid");
}

std::vector<Job> JobQueue::newestDone(int most)
{
    return select("WHERE state = 'done' ORDER BY rowid DESC LIMIT " + std::to_string(most));
}

std::vector<Job> JobQueue::jobs(const std::vector<CaseRecord>& cases)
{
    return select("WHERE case_id IN " + inList(cases));
}

int JobQueue::count(JobState state)
{
    int count = 0;
    database_.read([&](soci::session& sql) {
        sql << "SELECT COUNT(*) FROM jobs WHERE state = '" + nameOf(state) + "'", soci::into(count);
    });
    return count;
}

std::vector<Job> JobQueue::workedOnSince(const std::string& utc)
{
    std::vector<Job> jobs;
    database_.read([&](soci::session& sql) {
        jobs =
            jobsOf((sql.prepare << "SELECT * FROM jobs WHERE state = 'running' OR changed >= :since", soci::use(utc)));
    });
    return jobs;
}

std::optional<double> JobQueue::earliest(const std::string& column, const std::string& where)
{
    std::optional<double> earliest;
    database_.read([&](soci::session& sql) {
        double at = 0;
        soci::indicator there = soci::i_null;
        sql << "SELECT MIN(" + column + ") FROM jobs WHERE " + where, soci::into(at, there);
        earliest = there == soci::i_ok ? std::optional(at) : std::nullopt;
    });
    return earliest;
}

double JobQueue::oldestWait_s()
{
    const auto due = earliest("not_before", "state = 'queued' AND not_before > 0");
    return due ? std::max(0.0, now() - *due) : 0;
}

std::optional<double> JobQueue::nextDue()
{
    const auto due = earliest("not_before", "state = 'queued'"), lost = earliest("lease_until", "state = 'running'");
    return due && lost ? std::min(due, lost) : std::max(due, lost);
}

void JobQueue::putFirst(const std::string& case_id)
{
    database_.writeRows([&](soci::session& sql) {
        const double now = nowIn(sql);
        sql << "UPDATE jobs SET opened = :now WHERE case_id = :c AND state <> 'done'", soci::use(now),
            soci::use(case_id);
    });
}

bool JobQueue::reserveMemory(const Job& job, double mb, double most_mb)
{
    bool reserved = false;
    database_.write([&](soci::session& sql) {  // alone: two must not see the same room
        requireFence(sql, job);
        const std::string machine = machineOf(job.owner);
        double others_mb = 0;
        for (const Job& other : jobs(JobState::running))
            if (machineOf(other.owner) == machine && (other.case_id != job.case_id || other.scan_id != job.scan_id))
                others_mb += other.memory_mb;
        reserved = others_mb == 0 || others_mb + mb <= most_mb;
        if (reserved)
            sql << "UPDATE jobs SET memory_mb = :mb WHERE case_id = :c AND scan_id = :s", soci::use(mb),
                soci::use(job.case_id), soci::use(job.scan_id);
    });
    return reserved;
}

}  // namespace vicon
