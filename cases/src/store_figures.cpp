#include "vicon/cases/store_figures.h"

#include <soci/soci.h>

#include <chrono>
#include <ctime>
#include <filesystem>

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

std::string dateOf(std::filesystem::file_time_type time)
{
    const std::time_t seconds = std::chrono::system_clock::to_time_t(
        std::chrono::time_point_cast<std::chrono::system_clock::duration>(std::chrono::file_clock::to_sys(time)));
    std::tm fields{};
    ::gmtime_r(&seconds, &fields);
    char text[sizeof "2026-11-21"];
    std::strftime(text, sizeof text, "%Y-%m-%d", &fields);
    return text;
}

}  // namespace

Quarantine quarantineOf(const std::filesystem::path& store)
{
    namespace fs = std::filesystem;
    Quarantine found;
    std::error_code gone;  // there is none, or a person is at work in it
    for (auto entry = fs::recursive_directory_iterator(store / "quarantine", gone);
         !gone && entry != fs::recursive_directory_iterator(); entry.increment(gone)) {
        std::error_code unknown;
        if (!entry->is_regular_file(unknown))
            continue;
        ++found.objects;
        const auto time = entry->last_write_time(unknown);
        if (const std::string date = unknown ? "" : dateOf(time); !date.empty())
            found.since = found.since.empty() ? date : std::min(found.since, date);
    }
    return found;
}

StoreFigures figuresOf(CaseStore& store)
{
    JobQueue queue(store.database(), {});
    StoreFigures figures;
    for (const JobState state : {JobState::queued, JobState::running, JobState::done, JobState::failed})
        figures.jobs[nameOf(state)] = queue.count(state);
    figures.oldest_wait_s = queue.oldestWait_s();
    store.database().read([&](soci::session& sql) {
        for (const DeliveryState state : {DeliveryState::queued, DeliveryState::sending, DeliveryState::sent,
                                          DeliveryState::committed, DeliveryState::unconfirmed, DeliveryState::refused})
            figures.outbox[nameOf(state)] = objectsIn(sql, nameOf(state));
        figures.cases = countOf(sql, "cases");
        figures.scans = countOf(sql, "scans");
        figures.instances = countOf(sql, "instances");
        figures.steps = stepFigures(sql);
    });
    figures.quarantined = quarantineOf(store.folder()).objects;
    std::error_code unknown;
    const auto space = std::filesystem::space(store.folder(), unknown);
    figures.free_bytes = unknown ? 0 : double(space.available);
    return figures;
}

}  // namespace vicon
