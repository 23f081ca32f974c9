#include "worklist_rows.h"

#include <soci/soci.h>

#include <algorithm>

#include "case_rows.h"
#include "search_words.h"
#include "vicon/cases/report_files.h"
#include "vicon/core/error.h"

namespace vicon {
namespace {

using Rows = soci::rowset<soci::row>;

/// The cases that have a word beginning so, in the order of the words.
constexpr const char* kFound =
    "SELECT c.* FROM cases c JOIN (SELECT word, case_id FROM case_words WHERE word >= :from AND word < :to"
    " ORDER BY word, case_id LIMIT :most) found ON found.case_id = c.id ORDER BY found.word, found.case_id";

bool hasAll(const CaseRecord& a_case, const std::vector<std::string>& beginnings)
{
    const std::vector<std::string> words = searchWords(a_case);
    return std::ranges::all_of(beginnings, [&](const std::string& beginning) {
        return std::ranges::any_of(words, [&](const std::string& word) { return word.starts_with(beginning); });
    });
}

/// How many words of cases begin so; at most `most`.
int matches(soci::session& sql, const std::string& beginning, int most)
{
    int count = 0;
    const std::string to = endOf(beginning);
    sql << "SELECT COUNT(*) FROM (SELECT 1 FROM case_words WHERE word >= :from AND word < :to LIMIT :most) AS found",
        soci::use(beginning), soci::use(to), soci::use(most), soci::into(count);
    return count;
}

/// The rarest word finds, the others tell apart.
std::vector<CaseRecord> found(soci::session& sql, const std::vector<std::string>& words, int most)
{
    const std::string from =
        rarestOf(words, kMostLookedAt, [&](const std::string& word, int limit) { return matches(sql, word, limit); });
    const std::string to = endOf(from);
    // Where the others tell apart, more are looked at than are wanted.
    for (int looked_at = std::min(words.size() == 1 ? most : 2 * most, kMostLookedAt);;
         looked_at = std::min(4 * looked_at, kMostLookedAt)) {
        const Rows rows = (sql.prepare << kFound, soci::use(from), soci::use(to), soci::use(looked_at));
        const std::vector<CaseRecord> all = collect(rows, caseFrom);
        std::vector<CaseRecord> cases;
        for (const CaseRecord& c : all)
            if (int(cases.size()) < most && hasAll(c, words) &&
                std::ranges::none_of(cases, [&](const CaseRecord& other) { return other.id == c.id; }))
                cases.push_back(c);
        if (int(cases.size()) == most || int(all.size()) < looked_at || looked_at == kMostLookedAt)
            return cases;
    }
}

/// Where the cases are read from that may be in this state. Those that have a job in it: from the jobs where there are
/// few, else along all cases, so that the newest are found soon.
std::string casesWith(soci::session& sql, const std::optional<WorkState>& state)
{
    if (!state)
        return "cases c WHERE TRUE";
    if (*state == WorkState::kept || *state == WorkState::refused)  // of their scans none is worked on
        return "cases c WHERE NOT EXISTS (SELECT 1 FROM jobs JOIN scans ON scans.case_id = jobs.case_id AND"
               " scans.id = jobs.scan_id WHERE jobs.case_id = c.id AND scans.role <> '" +
               nameOf(ScanRole::refused) + "')";
    const std::string jobs = "jobs WHERE state = '" + nameOf(*state) + "'";
    int count = kMostLookedAt;
    if (*state != WorkState::done)  // mostly nearly all, and in no index
        sql << "SELECT COUNT(*) FROM (SELECT 1 FROM " + jobs + " LIMIT :most) AS found", soci::use(kMostLookedAt),
            soci::into(count);
    if (count < kMostLookedAt)
        return "(SELECT DISTINCT case_id FROM (SELECT case_id FROM " + jobs + " LIMIT " +
               std::to_string(kMostLookedAt) + ") AS few) found JOIN cases c ON c.id = found.case_id WHERE TRUE";
    return "cases c WHERE EXISTS (SELECT 1 FROM " + jobs + " AND jobs.case_id = c.id)";
}

std::vector<CaseRecord> pageOf(CaseStore& store, soci::session& sql, const WorklistPageWanted& wanted, int most)
{
    if (const auto words = wordsIn(wanted.words); !words.empty())
        return found(sql, words, most);
    const std::string from = casesWith(sql, wanted.state), order = " ORDER BY c.created DESC, c.id DESC LIMIT :most";
    if (wanted.after.empty()) {
        const Rows rows = (sql.prepare << "SELECT c.* FROM " + from + order, soci::use(most));
        return collect(rows, caseFrom);
    }
    const CaseRecord last = store.requireCase(wanted.after);
    const Rows rows = (sql.prepare << "SELECT c.* FROM " + from + " AND (c.created, c.id) < (:created, :id)" + order,
                       soci::use(last.created), soci::use(last.id), soci::use(most));
    return collect(rows, caseFrom);
}

void readRows(soci::session& sql, const std::string& these, WorklistRows& out)
{
    out.steps.clear();  // of a first try, over a connection that broke
    out.markers.clear();
    out.deliveries.clear();
    const Rows steps = (sql.prepare << "SELECT * FROM steps WHERE step IN ('segment', 'quality') AND case_id IN " +
                                           these + " ORDER BY rowid");
    for (const soci::row& row : steps)
        out.steps[{row.get<std::string>("case_id"), row.get<std::string>("scan_id")}].push_back(stepFrom(row));
    const soci::rowset<std::string> markers = (sql.prepare << "SELECT case_id FROM markers WHERE case_id IN " + these);
    for (const std::string& case_id : markers)
        ++out.markers[case_id];
    const Rows deliveries = (sql.prepare << "SELECT case_id, state FROM outbox WHERE case_id IN " + these);
    for (const soci::row& row : deliveries)
        ++out.deliveries[row.get<std::string>("case_id")][deliveryStateFrom(row.get<std::string>("state"))];
}

}  // namespace

std::vector<CaseRecord> casesOfPage(CaseStore& store, const WorklistPageWanted& wanted, int most)
{
    return store.database().read([&](soci::session& sql) { return pageOf(store, sql, wanted, most); });
}

WorklistRows worklistRows(CaseStore& store, const QueueOptions& options, const std::vector<CaseRecord>& cases)
{
    WorklistRows out;
    if (cases.empty())
        return out;
    for (ScanRecord& scan : store.scans(cases))
        out.scans[scan.case_id].push_back(std::move(scan));
    for (Job& job : JobQueue(store.database(), options).jobs(cases))
        out.jobs[{job.case_id, job.scan_id}] = std::move(job);
    out.reports = countReports(store, cases);
    store.database().read([&](soci::session& sql) { readRows(sql, inList(cases), out); });
    return out;
}

}  // namespace vicon
