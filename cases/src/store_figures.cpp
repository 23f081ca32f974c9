#include "vicon/cases/store_figures.h"

#include <soci/soci.h>

#include "vicon/cases/job_queue.h"
#include "vicon/cases/outbox.h"
#include "vicon/core/error.h"

namespace vicon {
namespace {

std::int64_t countOf(soci::session& sql, const std::string& table)
{
    long long count = 0;
    sql << "SELECT COUNT(*) FROM " + table, soci::into(count);
    return count;
}

int objectsIn(soci::session& sql, const std::string& state)
{
    int count = 0;
    sql << "SELECT COUNT(*) FROM outbox WHERE state = :s", soci::use(state), soci::into(count);
    return count;
}

std::map<std::string, StoreFigures::Step> stepFigures(soci::session& sql)
{
    std::vector<std::string> names;
    const soci::rowset<std::string> rows = (sql.prepare << "SELECT DISTINCT step FROM steps");
    names.assign(rows.begin(), rows.end());
    std::map<std::string, StoreFigures::Step> steps;
    for (const std::string& name : names) {
        long long count = 0;
        sql << "SELECT COUNT(*), COALESCE(SUM(seconds), 0) FROM steps WHERE step = :s", soci::use(name),
            soci::into(count), soci::into(steps[name].seconds);
        steps[name].count = count;
    }
    return steps;
}

}  // namespace

StoreFigures figuresOf(CaseStore& store)
{
    soci::session& sql = store.database().session();
    JobQueue queue(store.database(), {});
    StoreFigures figures;
    for (const JobState state : {JobState::queued, JobState::running, JobState::done, JobState::failed})
        figures.jobs[nameOf(state)] = queue.count(state);
    for (const DeliveryState state : {DeliveryState::queued, DeliveryState::sending, DeliveryState::sent,
                                      DeliveryState::committed, DeliveryState::unconfirmed, DeliveryState::refused})
        figures.outbox[nameOf(state)] = objectsIn(sql, nameOf(state));
    figures.cases = countOf(sql, "cases");
    figures.scans = countOf(sql, "scans");
    figures.instances = countOf(sql, "instances");
    figures.oldest_wait_s = queue.oldestWait_s();
    figures.steps = stepFigures(sql);
    std::error_code unknown;
    const auto space = std::filesystem::space(store.folder(), unknown);
    figures.free_bytes = unknown ? 0 : double(space.available);
    return figures;
}

}  // namespace vicon
