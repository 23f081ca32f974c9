#include "job_rows.h"

#include "database_engine.h"
#include "vicon/core/file.h"

namespace vicon {

double secondsIn(soci::session& sql)
{
    double seconds = 0;
    sql << (isPostgresql(sql) ? "SELECT CAST(EXTRACT(EPOCH FROM clock_timestamp()) AS DOUBLE PRECISION)"
                              : "SELECT (julianday('now') - 2440587.5) * 86400.0"),
        soci::into(seconds);
    return seconds;
}

std::string furthestName(const std::string& case_id, const std::string& scan_id)
{
    return "furthest " + case_id + "/" + scan_id;
}

void enqueueJob(soci::session& sql, const std::string& case_id, const std::string& scan_id)
{
    const std::string now = nowUtc();
    const double queued = secondsIn(sql);
    sql << "INSERT INTO jobs (case_id, scan_id, state, attempts, not_before, fence, owner, lease_until, step, progress,"
           " reason, changed, queued) VALUES (:case, :scan, 'queued', 0, 0, 0, '', 0, '', 0, '', :now, :queued)"
           " ON CONFLICT (case_id, scan_id) DO UPDATE SET state = 'queued', attempts = 0, not_before = 0,"
           " fence = jobs.fence + 1, owner = '', lease_until = 0, reason = '', changed = excluded.changed,"
           " queued = excluded.queued",
        soci::use(case_id), soci::use(scan_id), soci::use(now), soci::use(queued);
    const std::string furthest = furthestName(case_id, scan_id);
    sql << "DELETE FROM counters WHERE name = :name", soci::use(furthest);
    sql << "UPDATE jobs SET progress = 0 WHERE case_id = :c AND scan_id = :s", soci::use(case_id), soci::use(scan_id);
}

void withdrawJob(soci::session& sql, const std::string& case_id, const std::string& scan_id)
{
    sql << "DELETE FROM jobs WHERE case_id = :c AND scan_id = :s AND state <> 'done'", soci::use(case_id),
        soci::use(scan_id);
}

void removeJob(soci::session& sql, const std::string& case_id, const std::string& scan_id)
{
    sql << "DELETE FROM jobs WHERE case_id = :c AND scan_id = :s", soci::use(case_id), soci::use(scan_id);
}

}  // namespace vicon
