#include "changed_cases.h"

#include "vicon/cases/job_queue.h"
#include "vicon/core/file.h"

namespace vicon {

/// By the lines' numbers: the clocks of several machines differ.
ChangedCases::ChangedCases(CaseStore& store) : store_(store), since_(nowUtc())
{
    store.database().read(
        [&](soci::session& sql) { sql << "SELECT COALESCE(MAX(rowid), 0) FROM audit", soci::into(last_line_); });
    for (const Job& job : JobQueue(store.database(), {}).jobs(JobState::running))
        worked_on_.insert(job.case_id);
}

std::set<std::string> ChangedCases::untilNow()
{
    std::set<std::string> changed = worked_on_;
    store_.database().read([&](soci::session& sql) {
        const soci::rowset<std::string> cases =
            (sql.prepare << "SELECT DISTINCT case_id FROM audit WHERE rowid > :n AND case_id <> ''",
             soci::use(last_line_));
        changed.insert(cases.begin(), cases.end());
    });
    for (const Job& job : JobQueue(store_.database(), {}).workedOnSince(since_))
        changed.insert(job.case_id);
    return changed;
}

}  // namespace vicon
