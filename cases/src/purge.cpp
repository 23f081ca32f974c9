#include "vicon/cases/purge.h"

#include <soci/soci.h>

#include <chrono>
#include <ctime>

#include "case_rows.h"
#include "vicon/cases/report_versions.h"
#include "vicon/core/error.h"

namespace vicon {
namespace {

constexpr double kBytesAGb = 1e9, kSecondsADay = 86400;

struct Touched {
    std::string case_id, at;
};

Touched touchedFrom(const soci::row& row)
{
    return {row.get<std::string>("id"), row.get<std::string>("last_event")};
}

/// All cases, the longest untouched first: nothing happens to a case that its audit trail does not tell.
std::vector<Touched> byLastEvent(CaseStore& store)
{
    const soci::rowset<soci::row> rows =
        (store.database().session().prepare
         << "SELECT c.id AS id, COALESCE(MAX(a.at), MAX(c.created)) AS last_event FROM cases c"
            " LEFT JOIN audit a ON a.case_id = c.id GROUP BY c.id ORDER BY last_event, id");
    return collect(rows, touchedFrom);
}

/// A time as nowUtc() gives it, so many days earlier; such texts are in order as the times are.
std::string daysBefore(const std::string& utc, double days)
{
    std::tm fields{};
    if (!::strptime(utc.c_str(), "%Y-%m-%dT%H:%M:%SZ", &fields))
        throw Error(ErrorCode::internal, "a time that cannot be read", utc);
    const std::time_t earlier = ::timegm(&fields) - std::time_t(days * kSecondsADay);
    ::gmtime_r(&earlier, &fields);
    char text[sizeof "2026-11-21T08:15:30Z"];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &fields);
    return text;
}

std::string whyKept(CaseStore& store, const PurgeOptions& options, const std::string& case_id)
{
    const DeletionDoubts doubts = doubtsAboutDeleting(store, case_id);
    std::string why;
    for (const auto* lines : {&doubts.forbidding, &doubts.losses})
        for (const std::string& line : *lines)
            why += (why.empty() ? "" : "; ") + line;
    if (why.empty() && reportStatus(store, case_id).open() && !options.also_unread)
        why = "nobody read it, see purge.also_unread";
    return why;
}

}  // namespace

std::vector<PurgeCandidate> planPurge(CaseStore& store, const PurgeOptions& options, double free_gb,
                                      const std::string& now_utc)
{
    const std::string oldest = options.after_days > 0 ? daysBefore(now_utc, options.after_days) : "";
    std::vector<PurgeCandidate> plan;
    for (const Touched& touched : byLastEvent(store)) {
        const bool old = touched.at < oldest, full = free_gb < options.least_free_gb;
        if (!old && !full)
            break;  // those that follow are younger
        PurgeCandidate candidate{.case_id = touched.case_id,
                                 .last_event = touched.at,
                                 .size = sizeOfCase(store, touched.case_id),
                                 .rule = old ? "older than purge.after_days" : "less free than purge.least_free_gb",
                                 .kept = whyKept(store, options, touched.case_id)};
        if (candidate.kept.empty())
            free_gb += double(candidate.size.bytes) / kBytesAGb;
        plan.push_back(std::move(candidate));
    }
    return plan;
}

double freeGb(const std::filesystem::path& folder)
{
    std::error_code failed;
    const auto space = std::filesystem::space(folder, failed);
    if (failed)
        throw Error(ErrorCode::store, "free space cannot be found out (" + failed.message() + ")", folder.string());
    return double(space.available) / kBytesAGb;
}

}  // namespace vicon
