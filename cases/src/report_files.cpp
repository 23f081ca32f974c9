#include "vicon/cases/report_files.h"

#include <soci/soci.h>

#include <algorithm>

#include "case_rows.h"
#include "vicon/cases/organs.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon {
namespace {

/// Counts the drafts of a case; one of kCaseCounters.
std::string draftCounter(const std::string& case_id)
{
    return "report " + case_id;
}

int draftsIn(soci::session& sql, const std::string& case_id)
{
    const std::string name = draftCounter(case_id);
    int drafts = 0;
    sql << "SELECT COALESCE(MAX(value), 0) FROM counters WHERE name = :name", soci::use(name), soci::into(drafts);
    return drafts;
}

}  // namespace

fs::path reportFolder(const CaseStore& store, const std::string& case_id)
{
    return store.caseFolder(case_id) / "report";
}

std::string versionName(int version)
{
    return "version-" + std::to_string(version) + ".pdf";
}

std::vector<fs::path> versionObjects(const CaseStore& store, const std::string& case_id, int version)
{
    return versionObjectsIn(reportFolder(store, case_id), version);
}

std::vector<fs::path> versionObjectsIn(const fs::path& folder, int version)
{
    const std::string prefix = "version-" + std::to_string(version) + "-";
    std::vector<fs::path> files;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none))
        if (entry.path().filename().string().starts_with(prefix) && entry.path().extension() == ".dcm")
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

fs::path reportFile(CaseStore& store, const std::string& case_id, int number)
{
    const fs::path folder = reportFolder(store, case_id);
    makePrivateFolder(folder);
    return folder / (std::to_string(number) + ".pdf");
}

std::map<std::string, int> countReports(CaseStore& store, const std::vector<CaseRecord>& cases)
{
    std::map<std::string, int> counts;
    if (cases.empty())
        return counts;
    const std::string these = inList(cases);
    store.database().read([&](soci::session& sql) {
        counts.clear();
        const soci::rowset<soci::row> drafts =
            (sql.prepare << "SELECT c.id AS case_id, n.value AS number FROM cases c JOIN counters n ON n.name = '" +
                                draftCounter("") + "' || c.id WHERE c.id IN " + these);
        for (const soci::row& row : drafts)
            counts[row.get<std::string>("case_id")] += row.get<int>("number");
        const soci::rowset<std::string> versions =
            (sql.prepare << "SELECT case_id FROM report_versions WHERE case_id IN " + these);
        for (const std::string& case_id : versions)
            ++counts[case_id];
    });
    return counts;
}

int nextDraftNumber(CaseStore& store, const std::string& case_id)
{
    int drafts = 0;
    store.database().read([&](soci::session& sql) { drafts = draftsIn(sql, case_id); });
    return drafts + 1;
}

WrittenDraft writeDraft(CaseStore& store, const std::string& case_id, const fs::path& out,
                        const std::function<std::string(int number)>& draw)
{
    while (true) {
        const int number = nextDraftNumber(store, case_id);
        const fs::path file = out.empty() ? reportFile(store, case_id, number) : out;
        const std::string pdf = draw(number);
        if (!out.empty())
            replaceFile(out, pdf);  // a slow disk elsewhere must hold up nobody who writes to the database
        bool is_next = false;
        store.database().write([&](soci::session& sql) {
            is_next = draftsIn(sql, case_id) + 1 == number;
            if (!is_next)
                return;
            takeNumber(sql, draftCounter(case_id));
            putAudit(sql, AuditEvent::report_written, case_id, "", "number " + std::to_string(number));
            // Last: a kill before the commit leaves a file that the report that takes its number replaces.
            if (out.empty())
                replaceFile(file, pdf);
        });
        if (is_next)
            return {number, file};
    }
}

void requireReportable(CaseStore& store, const CaseRecord& record)
{
    std::string others;
    for (const ScanRecord& scan : store.scans(record.id)) {
        if (scan.role != ScanRole::scan)
            continue;
        const Organ organ = organOf(store, scan);
        if (organ.isColon())
            return;
        others += (others.empty() ? "" : ", ") + organ.name();
    }
    if (!others.empty())
        throw Error(ErrorCode::unusable_scan, "a report tells of a colon; the scans of this case show the " + others,
                    record.id, "'vicon show', 'vicon fly' and 'vicon snapshot' work on them");
}

}  // namespace vicon
