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

namespace {

std::string senderOf(soci::session& sql, const std::string& case_id, const std::string& scan_id)
{
    std::string sender;
    sql << "SELECT COALESCE(MAX(sender), '') FROM jobs WHERE case_id = :c AND scan_id = :s", soci::use(case_id),
        soci::use(scan_id), soci::into(sender);
    return sender;
}

/// After all that wait of the same sender. Who has none waiting comes into the turn that is being worked on.
int nextTurnOf(soci::session& sql, const std::string& sender, double now)
{
    int turn = 0;
    sql << "SELECT COALESCE((SELECT MAX(turn) + 1 FROM jobs WHERE state = 'queued' AND sender = :sender),"
           " (SELECT turn FROM jobs WHERE state = 'queued' AND not_before <= :now ORDER BY turn LIMIT 1), 0)",
        soci::use(sender), soci::use(now), soci::into(turn);
    return turn;
}

}  // namespace

void enqueueJob(soci::session& sql, const std::string& case_id, const std::string& scan_id,
                std::optional<std::string> sender)
{
    const std::string now = nowUtc();
    const double queued = secondsIn(sql);
    if (!sender)
        sender = senderOf(sql, case_id, scan_id);
    const int turn = nextTurnOf(sql, *sender, queued);
    sql << "INSERT INTO jobs (case_id, scan_id, state, attempts, not_before, fence, owner, lease_until, step, progress,"
           " reason, changed, queued, sender, turn) VALUES (:case, :scan, 'queued', 0, 0, 0, '', 0, '', 0, '', :now,"
           " :queued, :sender, :turn) ON CONFLICT (case_id, scan_id) DO UPDATE SET state = 'queued', attempts = 0, "
           "not_before = 0,"
           " fence = jobs.fence + 1, owner = '', lease_until = 0, reason = '', changed = excluded.changed,"
           " queued = excluded.queued, sender = excluded.sender, turn = excluded.turn",
        soci::use(case_id), soci::use(scan_id), soci::use(now), soci::use(queued), soci::use(*sender), soci::use(turn);
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
