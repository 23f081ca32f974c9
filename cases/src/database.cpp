#include "vicon/cases/database.h"

#include <fcntl.h>
#include <soci/soci.h>
#include <soci/sqlite3/soci-sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include "vicon/core/error.h"

namespace vicon {
namespace {

constexpr int kBusyTimeoutSeconds = 60;

/// The statements that lead from schema version n to n+1.
const std::vector<std::vector<const char*>> kMigrations = {
    {
        "CREATE TABLE cases (id TEXT PRIMARY KEY, study_uid TEXT NOT NULL UNIQUE, patient_id TEXT NOT NULL,"
        " patient_name TEXT NOT NULL, birth_date TEXT NOT NULL, sex TEXT NOT NULL, study TEXT NOT NULL,"
        " flags TEXT NOT NULL, created TEXT NOT NULL)",
        "CREATE INDEX cases_patient ON cases (patient_id)",
        "CREATE TABLE scans (id TEXT NOT NULL, case_id TEXT NOT NULL REFERENCES cases(id), series_uid TEXT NOT NULL,"
        " series TEXT NOT NULL, role TEXT NOT NULL, ingest TEXT NOT NULL, created TEXT NOT NULL,"
        " PRIMARY KEY (case_id, id))",
        "CREATE TABLE instances (sop_uid TEXT PRIMARY KEY, case_id TEXT NOT NULL, scan_id TEXT NOT NULL,"
        " sha256 TEXT NOT NULL, file TEXT NOT NULL)",
        "CREATE INDEX instances_scan ON instances (case_id, scan_id)",
        "CREATE TABLE steps (case_id TEXT NOT NULL, scan_id TEXT NOT NULL, step TEXT NOT NULL, version INTEGER NOT "
        "NULL,"
        " digest TEXT NOT NULL, parameters TEXT NOT NULL, result TEXT NOT NULL, seconds REAL NOT NULL,"
        " finished TEXT NOT NULL, PRIMARY KEY (case_id, scan_id, step))",
        "CREATE TABLE jobs (case_id TEXT NOT NULL, scan_id TEXT NOT NULL, state TEXT NOT NULL, attempts INTEGER NOT "
        "NULL,"
        " not_before REAL NOT NULL, fence INTEGER NOT NULL, owner TEXT NOT NULL, lease_until REAL NOT NULL,"
        " step TEXT NOT NULL, progress REAL NOT NULL, reason TEXT NOT NULL, changed TEXT NOT NULL,"
        " PRIMARY KEY (case_id, scan_id))",
        "CREATE INDEX jobs_state ON jobs (state, not_before)",
        "CREATE TABLE markers (case_id TEXT NOT NULL, id TEXT NOT NULL, scan_id TEXT NOT NULL, content TEXT NOT NULL,"
        " PRIMARY KEY (case_id, id))",
        "CREATE TABLE counters (name TEXT PRIMARY KEY, value INTEGER NOT NULL)",
        "CREATE TABLE audit (at TEXT NOT NULL, event TEXT NOT NULL, case_id TEXT NOT NULL, scan_id TEXT NOT NULL,"
        " detail TEXT NOT NULL)",
    },
    {
        // What a person said, and what was signed: neither is ever rewritten.
        "ALTER TABLE audit ADD COLUMN person TEXT NOT NULL DEFAULT ''",
        "ALTER TABLE audit ADD COLUMN old_value TEXT NOT NULL DEFAULT ''",
        "ALTER TABLE audit ADD COLUMN new_value TEXT NOT NULL DEFAULT ''",
        "CREATE INDEX audit_case ON audit (case_id)",
        "CREATE TRIGGER audit_is_not_changed BEFORE UPDATE ON audit"
        " BEGIN SELECT RAISE(ABORT, 'the audit trail is only appended to'); END",
        "CREATE TRIGGER audit_is_not_deleted BEFORE DELETE ON audit"
        " BEGIN SELECT RAISE(ABORT, 'the audit trail is only appended to'); END",
        "CREATE TABLE findings (case_id TEXT NOT NULL, id TEXT NOT NULL, content TEXT NOT NULL,"
        " PRIMARY KEY (case_id, id))",
        "CREATE TABLE assessments (case_id TEXT PRIMARY KEY, content TEXT NOT NULL)",
        "CREATE TABLE report_versions (case_id TEXT NOT NULL, version INTEGER NOT NULL, state TEXT NOT NULL,"
        " replaces INTEGER NOT NULL, reason TEXT NOT NULL, person TEXT NOT NULL, at TEXT NOT NULL,"
        " software TEXT NOT NULL, digest TEXT NOT NULL, content TEXT NOT NULL, file TEXT NOT NULL,"
        " file_sha256 TEXT NOT NULL, PRIMARY KEY (case_id, version))",
        "CREATE TRIGGER report_versions_are_not_changed BEFORE UPDATE ON report_versions"
        " BEGIN SELECT RAISE(ABORT, 'a version of a report never changes'); END",
        "CREATE TRIGGER report_versions_are_not_deleted BEFORE DELETE ON report_versions"
        " BEGIN SELECT RAISE(ABORT, 'a version of a report never changes'); END",
        "CREATE TABLE amendments (case_id TEXT PRIMARY KEY, reason TEXT NOT NULL, person TEXT NOT NULL,"
        " at TEXT NOT NULL)",
    },
    {
        // One object for one peer is one item. An id is not given twice: a dropped item's never names another.
        "CREATE TABLE outbox (id INTEGER PRIMARY KEY AUTOINCREMENT, case_id TEXT NOT NULL, peer TEXT NOT NULL,"
        " sop_class TEXT NOT NULL, sop_uid TEXT NOT NULL, file TEXT NOT NULL, sha256 TEXT NOT NULL,"
        " state TEXT NOT NULL, stored INTEGER NOT NULL, attempts INTEGER NOT NULL, not_before REAL NOT NULL,"
        " fence INTEGER NOT NULL, owner TEXT NOT NULL, lease_until REAL NOT NULL, transaction_uid TEXT NOT NULL,"
        " reason TEXT NOT NULL, created TEXT NOT NULL, changed TEXT NOT NULL, UNIQUE (peer, sop_uid))",
        "CREATE INDEX outbox_state ON outbox (state, not_before)",
        "CREATE INDEX outbox_case ON outbox (case_id)",
        "CREATE INDEX outbox_transaction ON outbox (transaction_uid)",
    },
};
static_assert(Database::kSchemaVersion == 3, "add a migration for every version");

/// In the reader's words where one can do something about it.
Error refusal(const soci::soci_error& e)
{
    constexpr const char* kRemedy = "check the disk, then run again";
    const auto* sqlite = dynamic_cast<const soci::sqlite3_soci_error*>(&e);
    switch (sqlite ? sqlite->result() & 0xff : SQLITE_OK) {  // the rest of it tells kinds of the same trouble apart
        case SQLITE_FULL:
            return {ErrorCode::database,
                    "the store's disk is full; nothing was saved",
                    {},
                    "free some space on it and try again"};
        case SQLITE_IOERR:
            return {ErrorCode::database,
                    "the store's disk cannot be written; nothing was saved",
                    {},
                    "see whether it is full or at fault, then try again"};
        case SQLITE_BUSY:
            return {ErrorCode::database,
                    "another program keeps the database busy; nothing was saved",
                    {},
                    "try again in a moment"};
        default:
            return {ErrorCode::database, std::string("the database refused (") + e.what() + ")", {}, kRemedy};
    }
}

/// The folder of a database, by a name without any sign that a connection string reads in its own way. SQLite finds the
/// place behind it, and keeps that.
class Folder {
public:
    explicit Folder(const std::filesystem::path& file)
        : descriptor_(
              ::open(file.has_parent_path() ? file.parent_path().c_str() : ".", O_PATH | O_DIRECTORY | O_CLOEXEC))
    {
    }
    ~Folder()
    {
        if (descriptor_ >= 0)
            ::close(descriptor_);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    std::string name(const std::filesystem::path& file) const
    {
        return "/proc/self/fd/" + std::to_string(descriptor_) + "/" + file.filename().string();
    }

private:
    int descriptor_;
};

/// Nobody else may read the database, at no moment. SQLite gives its other files the same mode. The file is made
/// without being opened: closing it again would drop the locks of every connection that this process has to it, and
/// another program would delete the log under them (sqlite.org/howtocorrupt.html, section 2.2).
void createPrivately(const std::filesystem::path& file)
{
    ::mknod(file.c_str(), S_IFREG | 0600, 0);  // that it is there, or cannot be made, SQLite finds
    ::chmod(file.c_str(), 0600);
}

}  // namespace

Database::Database(const std::filesystem::path& file)
{
    try {
        const Folder folder(file);
        createPrivately(file);
        session_ = std::make_unique<soci::session>(
            soci::sqlite3, "dbname=" + folder.name(file) + " timeout=" + std::to_string(kBusyTimeoutSeconds));
        *session_ << "PRAGMA journal_mode = WAL";
        *session_ << "PRAGMA synchronous = FULL";
        *session_ << "PRAGMA foreign_keys = ON";
        migrate();
    } catch (const soci::soci_error& e) {
        throw Error(ErrorCode::database, std::string("database cannot be opened (") + e.what() + ")", file.string(),
                    "check that the folder is yours, on a local disk, and not full");
    }
}

Database::~Database() = default;

void Database::migrate()
{
    int version = 0;
    *session_ << "PRAGMA user_version", soci::into(version);
    if (version == kSchemaVersion)
        return;
    write([&](soci::session& sql) {
        sql << "PRAGMA user_version", soci::into(version);  // again: another process may have migrated meanwhile
        if (version > kSchemaVersion)
            throw Error(ErrorCode::database,
                        "the store has schema version " + std::to_string(version) + ", this VICON knows up to " +
                            std::to_string(kSchemaVersion),
                        {}, "use the newer VICON that wrote it");
        for (; version < kSchemaVersion; ++version)
            for (const char* statement : kMigrations[std::size_t(version)])
                sql << statement;
        sql << "PRAGMA user_version = " + std::to_string(kSchemaVersion);
    });
}

std::string Database::damage()
{
    try {
        std::string found;
        *session_ << "PRAGMA integrity_check(1)", soci::into(found);
        return found == "ok" ? "" : found;
    } catch (const soci::soci_error& e) {
        return e.what();
    }
}

std::string Database::version()
{
    try {
        long long by_others = 0, by_this = 0;
        *session_ << "PRAGMA data_version", soci::into(by_others);
        *session_ << "SELECT total_changes()", soci::into(by_this);
        return std::to_string(by_others) + "/" + std::to_string(by_this);
    } catch (const soci::soci_error& e) {
        throw refusal(e);
    }
}

void Database::write(const std::function<void(soci::session&)>& work)
{
    try {
        *session_ << "BEGIN IMMEDIATE";
        try {
            work(*session_);
            *session_ << "COMMIT";
        } catch (...) {
            try {
                *session_ << "ROLLBACK";
            } catch (const soci::soci_error&) {  // SQLite has rolled back by itself, as it does on a full disk
            }
            throw;
        }
    } catch (const soci::soci_error& e) {
        throw refusal(e);
    }
}

}  // namespace vicon
