#include "vicon/cases/case_store.h"

#include <soci/soci.h>

#include <algorithm>
#include <random>

#include "case_rows.h"
#include "database_backup.h"
#include "database_engine.h"
#include "job_rows.h"
#include "search_words.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace vicon {
namespace {

constexpr std::size_t kIdDigits =
    10;  // 40 bits: among 10,000 cases two ids collide with probability 5e-5, and then import refuses

constexpr const char* kOwnDatabase = "vicon.db";

/// Throws Error{store} where that is not for this account to know.
bool isThere(const fs::path& file)
{
    std::error_code trouble;
    const bool there = fs::exists(file, trouble);
    if (trouble)
        throw Error(ErrorCode::store, "the store cannot be used (" + trouble.message() + ")",
                    file.parent_path().string(), "see that this account may look into its folder");
    return there;
}

/// Makes the store's folder, and says where its database lies.
std::string databaseOf(const StorePlace& place)
{
    const bool on_server = !place.database.empty();
    if (on_server && !isServerAddress(place.database))
        throw Error(ErrorCode::wrong_use, "this is no address of a database", "store.database",
                    "give it as postgresql://USER@HOST:PORT/NAME");
    if (isThere(place.folder / (on_server ? kOwnDatabase : kServersDatabase)))
        throw Error(ErrorCode::store,
                    on_server ? "the store keeps its state in its own vicon.db, not in store.database"
                              : "the store keeps its state in a PostgreSQL database",
                    place.folder.string(),
                    on_server ? "give another --store, or no store.database" : "set store.database to its address");
    std::error_code none;
    const fs::path own = place.folder / kOwnDatabase;
    if (!on_server && place.holdsData() && (!isThere(own) || fs::file_size(own, none) == 0))
        throw databaseIsLost(own);  // before SQLite makes a file
    makePrivateFolder(place.folder / "cases");
    return on_server ? place.database : (place.folder / kOwnDatabase).string();
}

/// State and data of two stores must never be mixed: the folder and the server's database hold the same name.
void requireOneStore(const fs::path& folder, Database& database)
{
    const fs::path file = folder / kServersDatabase;
    database.write([&](soci::session& sql) {
        std::string in_database, in_folder = fs::exists(file) ? readFile(file) : "";
        sql << "SELECT id FROM store", soci::into(in_database);
        if (in_database.empty() && in_folder.empty()) {
            in_database = in_folder = sha256(std::to_string(std::random_device()()) + nowUtc() + folder.string());
            sql << "UPDATE store SET id = :id", soci::use(in_database);
            replaceFile(file, in_folder);
        }
        if (in_database != in_folder)
            throw Error(ErrorCode::store, "the folder and store.database belong to different stores", folder.string(),
                        "give the folder that all machines share, and the database that goes with it");
    });
}

std::vector<ScanRecord> inOrder(std::vector<ScanRecord> scans)
{
    std::stable_sort(scans.begin(), scans.end(), [](const ScanRecord& a, const ScanRecord& b) {
        return a.role == b.role && a.series.number < b.series.number;
    });
    return scans;
}

}  // namespace

bool StorePlace::holdsStore() const
{
    return isThere(folder / kOwnDatabase) || isThere(folder / kServersDatabase);
}

bool StorePlace::holdsData() const
{
    std::error_code none;
    for (const char* of_store : {"cases", "reports", "quarantine", "incoming", "deleted"})
        for (const auto& entry : fs::directory_iterator(folder / of_store, none))
            if (entry.is_directory(none) || entry.path().extension() == ".dcm")
                return true;
    return false;
}

CaseStore::CaseStore(const StorePlace& place)
    : place_(fs::absolute(place.folder).lexically_normal(), place.database),
      database_(databaseOf(place_), !place_.holdsData())
{
    if (!place_.database.empty())
        requireOneStore(folder(), database_);
    makeSearchWords();
    renewMarkerFiles();
}

/// Cases that a version without a search took in have no words yet.
void CaseStore::makeSearchWords()
{
    constexpr const char* kIsMade = "SELECT COUNT(*) FROM counters WHERE name = 'search words'";
    int made = 0;
    database_.read([&](soci::session& sql) { sql << kIsMade, soci::into(made); });
    if (made > 0)
        return;
    database_.write([&](soci::session& sql) {
        sql << kIsMade, soci::into(made);
        if (made > 0)
            return;
        for (const CaseRecord& c : cases())
            putSearchWords(sql, c);
        sql << "INSERT INTO counters (name, value) VALUES ('search words', 1)";
    });
}

fs::path CaseStore::caseFolder(const std::string& case_id) const
{
    return folder() / "cases" / case_id;
}

fs::path CaseStore::scanFolder(const std::string& case_id, const std::string& scan_id) const
{
    return caseFolder(case_id) / scan_id;
}

std::string CaseStore::caseIdFor(const std::string& study_uid)
{
    return "c" + sha256(study_uid).substr(0, kIdDigits);
}

std::string CaseStore::scanIdFor(const std::string& scan_key)
{
    return "s" + sha256(scan_key).substr(0, kIdDigits);
}

std::vector<CaseRecord> CaseStore::cases()
{
    return database_.read([&](soci::session& sql) {
        const soci::rowset<soci::row> rows = (sql.prepare << "SELECT * FROM cases ORDER BY created, id");
        return collect(rows, caseFrom);
    });
}

std::optional<CaseRecord> CaseStore::findCase(const std::string& case_id)
{
    const auto found = database_.read([&](soci::session& sql) {
        const soci::rowset<soci::row> rows = (sql.prepare << "SELECT * FROM cases WHERE id = :id", soci::use(case_id));
        return collect(rows, caseFrom);
    });
    return found.empty() ? std::nullopt : std::optional(found.front());
}

std::optional<CaseRecord> CaseStore::findCaseByStudy(const std::string& study_uid)
{
    const auto found = database_.read([&](soci::session& sql) {
        const soci::rowset<soci::row> rows =
            (sql.prepare << "SELECT * FROM cases WHERE study_uid = :uid", soci::use(study_uid));
        return collect(rows, caseFrom);
    });
    return found.empty() ? std::nullopt : std::optional(found.front());
}

std::vector<CaseRecord> CaseStore::findCasesByPatient(const std::string& patient_id)
{
    return database_.read([&](soci::session& sql) {
        const soci::rowset<soci::row> rows =
            (sql.prepare << "SELECT * FROM cases WHERE patient_id = :id ORDER BY id", soci::use(patient_id));
        return collect(rows, caseFrom);
    });
}

CaseRecord CaseStore::requireCase(const std::string& case_id)
{
    if (auto found = findCase(case_id))
        return *found;
    std::vector<CaseRecord> matching;
    for (CaseRecord& c : cases())
        if (!case_id.empty() && c.id.starts_with(case_id))
            matching.push_back(std::move(c));
    if (matching.size() == 1)
        return matching.front();
    throw Error(ErrorCode::not_found, matching.empty() ? "no such case" : "several cases begin so", "'" + case_id + "'",
                "'vicon cases' lists them");
}

std::vector<ScanRecord> CaseStore::scans(const std::string& case_id)
{
    return inOrder(database_.read([&](soci::session& sql) {
        const soci::rowset<soci::row> rows =
            (sql.prepare << "SELECT * FROM scans WHERE case_id = :id ORDER BY role DESC, id", soci::use(case_id));
        return collect(rows, scanFrom);
    }));
}

std::vector<ScanRecord> CaseStore::scans(const std::vector<CaseRecord>& cases)
{
    return inOrder(database_.read([&](soci::session& sql) {
        const soci::rowset<soci::row> rows =
            (sql.prepare << "SELECT * FROM scans WHERE case_id IN " + inList(cases) + " ORDER BY role DESC, id");
        return collect(rows, scanFrom);
    }));
}

ScanRecord CaseStore::requireScan(const std::string& case_id, const std::string& scan_id)
{
    std::vector<ScanRecord> candidates;
    for (ScanRecord& scan : scans(case_id))
        if (scan_id.empty() ? scan.role == ScanRole::scan : scan.id.starts_with(scan_id))
            candidates.push_back(std::move(scan));
    if (candidates.size() == 1)
        return candidates.front();
    if (candidates.empty())
        throw Error(ErrorCode::not_found, scan_id.empty() ? "the case has no scan" : "no such scan '" + scan_id + "'",
                    case_id, "'vicon show " + case_id + "' lists its scans");
    throw Error(ErrorCode::wrong_use, "the case has several scans", case_id,
                "name one with --scan; 'vicon show " + case_id + "' lists them");
}

std::optional<InstanceRecord> CaseStore::findInstance(const std::string& sop_uid)
{
    const auto found = database_.read([&](soci::session& sql) {
        const soci::rowset<soci::row> rows =
            (sql.prepare << "SELECT * FROM instances WHERE sop_uid = :uid", soci::use(sop_uid));
        return collect(rows, instanceFrom);
    });
    return found.empty() ? std::nullopt : std::optional(found.front());
}

std::vector<InstanceRecord> CaseStore::instances(const std::string& case_id, const std::string& scan_id)
{
    return database_.read([&](soci::session& sql) {
        const soci::rowset<soci::row> rows =
            (sql.prepare << "SELECT * FROM instances WHERE case_id = :c AND scan_id = :s ORDER BY file",
             soci::use(case_id), soci::use(scan_id));
        return collect(rows, instanceFrom);
    });
}

void CaseStore::addScan(const CaseRecord& a_case, const ScanRecord& scan, const std::vector<InstanceRecord>& instances,
                        bool queue, const std::function<void()>& require, const std::string& flag)
{
    database_.write([&](soci::session& sql) {
        if (require)
            require();
        putCase(sql, a_case);
        if (!flag.empty())
            putFlag(sql, a_case.id, flag);
        putScan(sql, scan);
        putInstances(sql, instances);
        if (queue)
            enqueueJob(sql, scan.case_id, scan.id, scan.ingest.value(kIngestSender, ""));
        else if (scan.role != ScanRole::scan)
            withdrawJob(sql, scan.case_id, scan.id);
        putAudit(sql, AuditEvent::imported, scan.case_id, scan.id, std::to_string(instances.size()) + " objects");
    });
    writeScanFile(scan.case_id, scan.id);
}

void CaseStore::removeScan(const std::string& case_id, const std::string& scan_id)
{
    int in_use = 0;
    database_.write([&](soci::session& sql) {
        sql << "SELECT (SELECT COUNT(*) FROM instances WHERE case_id = :c AND scan_id = :s)"
               " + (SELECT COUNT(*) FROM markers WHERE case_id = :mc AND scan_id = :ms)",
            soci::use(case_id), soci::use(scan_id), soci::use(case_id), soci::use(scan_id), soci::into(in_use);
        if (in_use > 0)
            return;
        removeJob(sql, case_id, scan_id);
        sql << "DELETE FROM steps WHERE case_id = :c AND scan_id = :s", soci::use(case_id), soci::use(scan_id);
        sql << "DELETE FROM scans WHERE case_id = :c AND id = :s", soci::use(case_id), soci::use(scan_id);
        putAudit(sql, AuditEvent::scan_removed, case_id, scan_id, "");
    });
    std::error_code ignored;  // what stays belongs to no scan any more
    if (in_use == 0)
        fs::remove_all(scanFolder(case_id, scan_id), ignored);
}

std::vector<StepRecord> CaseStore::steps(const std::string& case_id, const std::string& scan_id)
{
    return database_.read([&](soci::session& sql) {
        const soci::rowset<soci::row> rows =
            (sql.prepare << "SELECT * FROM steps WHERE case_id = :c AND scan_id = :s ORDER BY rowid",
             soci::use(case_id), soci::use(scan_id));
        return collect(rows, stepFrom);
    });
}

scan_files::ScanDescription CaseStore::describeScan(const std::string& case_id, const std::string& scan_id)
{
    const CaseRecord c = requireCase(case_id);
    const ScanRecord scan = requireScan(case_id, scan_id);
    return {.case_id = c.id,
            .scan_id = scan.id,
            .patient = c.patient,
            .study = c.study,
            .series = scan.series,
            .role = scan.role,
            .created = scan.created,
            .ingest = scan.ingest,
            .steps = steps(case_id, scan_id)};
}

void CaseStore::writeScanFile(const std::string& case_id, const std::string& scan_id)
{
    scan_files::writeDescription(scanFolder(case_id, scan_id), describeScan(case_id, scan_id));
}

int CaseStore::nextNumber(const std::string& name)
{
    int value = 0;
    database_.write([&](soci::session& sql) { value = takeNumber(sql, name); });
    return value;
}

void CaseStore::audit(AuditEvent event, const std::string& case_id, const std::string& scan_id,
                      const std::string& detail)
{
    database_.write([&](soci::session& sql) { putAudit(sql, event, case_id, scan_id, detail); });
}

}  // namespace vicon
