#include "vicon/cases/case_deletion.h"

#include <soci/soci.h>

#include "case_rows.h"
#include "case_tables.h"
#include "deleted_case.h"
#include "job_owner.h"
#include "vicon/cases/findings.h"
#include "vicon/cases/job_queue.h"
#include "vicon/cases/kept_reports.h"
#include "vicon/cases/outbox.h"
#include "vicon/cases/reader_input.h"
#include "vicon/cases/report_versions.h"
#include "vicon/cases/roles.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/uid.h"

namespace fs = std::filesystem;

namespace vicon {
namespace {

/// What is being deleted lies here, one folder a deletion, until nothing of it is left.
fs::path deletedFolder(const CaseStore& store)
{
    return store.folder() / "deleted";
}

/// One deletion: its mark names the folder, and stands in the database once the deletion holds.
struct Deletion {
    std::string case_id, mark;

    std::string folderName() const { return case_id + "-" + mark; }
};

/// The places of a case in the store, and what they are moved to; of the folder of kept reports, what goes with it.
std::vector<std::pair<fs::path, fs::path>> placesOf(const CaseStore& store, const Deletion& deletion)
{
    const fs::path aside = deletedFolder(store) / deletion.folderName();
    return {{store.caseFolder(deletion.case_id), aside / "case"},
            {store.folder() / "quarantine" / deletion.case_id, aside / "quarantine"},
            {keptReportsFolder(store), aside / "reports"}};
}

int countIn(CaseStore& store, const char* table, const std::string& case_id)
{
    int count = 0;
    store.database().read([&](soci::session& sql) {
        sql << std::string("SELECT COUNT(*) FROM ") + table + " WHERE case_id = :c", soci::use(case_id),
            soci::into(count);
    });
    return count;
}

template <class Visit>
void visitFiles(const fs::path& folder, const Visit& visit)
{
    std::error_code gone;  // others may be at work there
    for (auto entry = fs::recursive_directory_iterator(folder, gone); !gone && entry != fs::end(entry);
         entry.increment(gone))
        if (entry->is_regular_file(gone))
            visit(*entry);
}

int countFiles(const fs::path& folder)
{
    int count = 0;
    visitFiles(folder, [&](const fs::directory_entry&) { ++count; });
    return count;
}

/// Whether anybody said something of the case, which a report would tell.
bool hasReaderInput(CaseStore& store, const std::string& case_id)
{
    if (countIn(store, "findings", case_id) + countIn(store, "assessments", case_id) > 0)
        return true;
    const auto scans = store.scans(case_id);
    return std::any_of(scans.begin(), scans.end(), [&](const ScanRecord& scan) { return hasReaderInput(store, scan); });
}

int countUndelivered(CaseStore& store, const std::string& case_id)
{
    int undelivered = 0;
    for (const auto& [state, count] : countDeliveries(store, case_id))
        undelivered += state == DeliveryState::committed || state == DeliveryState::unconfirmed ? 0 : count;
    return undelivered;
}

/// What the audit trail keeps of the case: no more than tells what was deleted.
std::string inBrief(CaseStore& store, const std::string& case_id)
{
    return std::to_string(countIn(store, "scans", case_id)) + " scans, " +
           std::to_string(countIn(store, "instances", case_id)) + " objects, report " +
           textOf(reportStatus(store, case_id));
}

std::string whoseItWas(CaseStore& store, const std::string& case_id)
{
    const CaseRecord record = store.requireCase(case_id);
    return nlohmann::json{{kPatientIdKey, record.patient.id}, {kStudyUidKey, record.study.uid}}.dump();
}

std::string joined(const std::vector<std::string>& lines)
{
    std::string out;
    for (const std::string& line : lines)
        out += (out.empty() ? "" : "; ") + line;
    return out;
}

void requireNoDoubts(CaseStore& store, const std::string& case_id, bool accept_losses)
{
    const DeletionDoubts doubts = doubtsAboutDeleting(store, case_id);
    if (!doubts.forbidding.empty())
        throw Error(ErrorCode::wrong_use, joined(doubts.forbidding), case_id, "wait for it to end, then try again");
    if (!accept_losses && !doubts.losses.empty())
        throw Error(ErrorCode::wrong_use, joined(doubts.losses), case_id, "--lose deletes it all the same");
}

void moveAside(const CaseStore& store, const Deletion& deletion, const std::vector<std::string>& reports)
{
    makePrivateFolder(deletedFolder(store) / deletion.folderName());
    for (const auto& [home, aside] : placesOf(store, deletion)) {
        if (home != keptReportsFolder(store) && fs::exists(home))
            fs::rename(home, aside);
        for (const std::string& report : reports)
            if (home == keptReportsFolder(store) && fs::exists(home / report)) {
                makePrivateFolder(aside);
                fs::rename(home / report, aside / report);
            }
    }
}

/// Where somebody made a folder of that name meanwhile, what was moved aside joins what lies in it.
void moveInto(const fs::path& from, const fs::path& to)
{
    if (!fs::is_directory(from) || !fs::exists(to)) {
        makePrivateFolder(to.parent_path());
        fs::rename(from, to);
        return;
    }
    std::vector<fs::path> children;
    for (const auto& entry : fs::directory_iterator(from))
        children.push_back(entry.path());
    for (const fs::path& child : children)
        moveInto(child, to / child.filename());
}

void moveBack(const CaseStore& store, const Deletion& deletion)
{
    for (const auto& [home, aside] : placesOf(store, deletion))
        if (fs::exists(aside))
            moveInto(aside, home);
    std::error_code ignored;
    fs::remove_all(deletedFolder(store) / deletion.folderName(), ignored);
}

/// Within a transaction. The row of "deletions" is also what lets versions of reports go.
void deleteRows(soci::session& sql, const Deletion& deletion)
{
    const std::string& case_id = deletion.case_id;
    sql << "INSERT INTO deletions (mark, case_id) VALUES (:m, :c)", soci::use(deletion.mark), soci::use(case_id);
    for (const char* table : kCaseTables)
        sql << std::string("DELETE FROM ") + table + " WHERE case_id = :c", soci::use(case_id);
    for (const char* counter : kCaseCounters) {
        const std::string exactly = std::string(counter) + " " + case_id, of_scans = exactly + "/%";
        sql << "DELETE FROM counters WHERE name = :n OR name LIKE :s", soci::use(exactly), soci::use(of_scans);
    }
    sql << "DELETE FROM cases WHERE id = :c", soci::use(case_id);
}

/// Earlier reports of a patient that came from elsewhere go with the last case of the patient. Within a transaction.
/// Returns their files.
std::vector<std::string> deleteKeptReports(CaseStore& store, soci::session& sql, const std::string& case_id)
{
    const std::string patient_id = store.requireCase(case_id).patient.id;
    std::vector<std::string> files;
    if (patient_id.empty() || store.findCasesByPatient(patient_id).size() > 1)
        return files;
    for (const KeptReport& report : keptReportsOf(store, patient_id)) {
        sql << "DELETE FROM kept_reports WHERE sop_uid = :uid", soci::use(report.sop_uid);
        files.push_back(report.file);
    }
    return files;
}

/// Alone with the database: a commit whose answer was lost may still be under way.
bool holds(CaseStore& store, const Deletion& deletion)
{
    int count = 0;
    store.database().write([&](soci::session& sql) {
        sql << "SELECT COUNT(*) FROM deletions WHERE mark = :m", soci::use(deletion.mark), soci::into(count);
    });
    return count > 0;
}

/// Of a deletion that holds. What cannot be removed now is removed by finishDeletions().
void removeRest(CaseStore& store, const Deletion& deletion)
{
    std::error_code failed;
    fs::remove_all(deletedFolder(store) / deletion.folderName(), failed);
    if (!failed)
        store.database().write(
            [&](soci::session& sql) { sql << "DELETE FROM deletions WHERE mark = :m", soci::use(deletion.mark); });
}

/// After trouble: what was moved aside goes back, unless the deletion holds all the same. Where the database cannot be
/// asked it stays aside: finishDeletions() asks again. Returns whether it holds.
bool holdsAfterAll(CaseStore& store, const Deletion& deletion)
{
    try {
        if (holds(store, deletion))
            return true;
    } catch (const Error&) {
        return false;
    }
    moveBack(store, deletion);
    return false;
}

}  // namespace

DeletionDoubts doubtsAboutDeleting(CaseStore& store, const std::string& case_id)
{
    DeletionDoubts doubts;
    JobQueue queue(store.database(), {});
    for (const ScanRecord& scan : store.scans(case_id))
        if (const auto job = queue.find(case_id, scan.id);
            job && job->state == JobState::running && job->lease_until > queue.now() && !ownerIsGone(job->owner))
            doubts.forbidding.push_back("a worker is at work on scan " + scan.id);
    const ReportStatus report = reportStatus(store, case_id);
    if (report.amending)
        doubts.losses.push_back("the amendment of its report is not signed");
    else if (report.open() && hasReaderInput(store, case_id))
        doubts.losses.push_back("it was read, and its report is not signed");
    if (const int undelivered = countUndelivered(store, case_id); undelivered > 0)
        doubts.losses.push_back(std::to_string(undelivered) + " of its objects are not delivered");
    if (const int files = countFiles(store.folder() / "quarantine" / case_id); files > 0)
        doubts.losses.push_back(std::to_string(files) + " objects that came with it are in quarantine");
    return doubts;
}

CaseSize sizeOfCase(CaseStore& store, const std::string& case_id)
{
    CaseSize size{.scans = countIn(store, "scans", case_id), .objects = countIn(store, "instances", case_id)};
    visitFiles(store.caseFolder(case_id), [&](const fs::directory_entry& file) {
        std::error_code gone;
        const auto bytes = file.file_size(gone);
        size.bytes += gone ? 0 : bytes;
    });
    return size;
}

void deleteCase(CaseStore& store, const std::string& case_id, bool accept_losses, const std::string& why,
                Progress& progress)
{
    requireRole(Role::operate);
    const StoreLock lock(store.folder(), progress);
    finishDeletions(store, lock);
    if (!store.findCase(case_id))
        throw Error(ErrorCode::not_found, "no such case", case_id, "'vicon cases' lists them");
    CaseUnused unused(store.folder(), case_id);
    const Deletion deletion{case_id, sha256(randomUid())};
    try {
        store.database().write([&](soci::session& sql) {
            requireNoDoubts(store, case_id, accept_losses);
            putAudit(sql, {AuditEvent::case_deleted, case_id, "", why + ": " + inBrief(store, case_id),
                           whoseItWas(store, case_id), ""});
            const auto reports = deleteKeptReports(store, sql, case_id);
            deleteRows(sql, deletion);
            moveAside(store, deletion, reports);  // last: what is left to fail is the commit
        });
    } catch (const fs::filesystem_error& e) {
        if (!holdsAfterAll(store, deletion))
            throw Error(ErrorCode::store, "the case's folder cannot be moved (" + e.code().message() + ")", case_id,
                        "check that the store is yours, and its disk not full");
    } catch (...) {
        if (!holdsAfterAll(store, deletion))
            throw;
    }
    unused.forget();
    removeRest(store, deletion);
}

bool hasBegunDeletions(const CaseStore& store)
{
    std::error_code none;
    return fs::directory_iterator(deletedFolder(store), none) != fs::directory_iterator();
}

void finishDeletions(CaseStore& store, const StoreLock&)
{
    std::vector<Deletion> begun;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(deletedFolder(store), none)) {
        const std::string name = entry.path().filename().string();
        if (const auto dash = name.find('-'); dash != std::string::npos)
            begun.push_back({name.substr(0, dash), name.substr(dash + 1)});
    }
    for (const Deletion& deletion : begun)
        if (holds(store, deletion))
            removeRest(store, deletion);
        else
            moveBack(store, deletion);
}

}  // namespace vicon
