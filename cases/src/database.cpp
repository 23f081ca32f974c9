#include "vicon/cases/database.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>
#include <typeinfo>
#include <utility>

#include "database_engine.h"

namespace vicon {
namespace {

constexpr std::chrono::milliseconds kBetweenTries{100};
/// What is run again after the connection broke.
constexpr int kMostRuns = 3;

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
    {
        // A million of each: what waits, what runs and what failed have indexes of their own.
        "ALTER TABLE jobs ADD COLUMN opened REAL NOT NULL DEFAULT 0",
        "ALTER TABLE jobs ADD COLUMN queued REAL NOT NULL DEFAULT 0",
        "ALTER TABLE jobs ADD COLUMN memory_mb REAL NOT NULL DEFAULT 0",
        "DROP INDEX jobs_state",
        "CREATE INDEX jobs_waiting ON jobs (opened DESC, queued) WHERE state = 'queued'",
        "CREATE INDEX jobs_due ON jobs (not_before) WHERE state = 'queued'",
        "CREATE INDEX jobs_running ON jobs (lease_until) WHERE state = 'running'",
        "CREATE INDEX jobs_failed ON jobs (case_id, scan_id) WHERE state = 'failed'",
        "CREATE INDEX cases_created ON cases (created, id)",
        "CREATE TABLE case_words (word TEXT NOT NULL, case_id TEXT NOT NULL, PRIMARY KEY (word, case_id))",
    },
    {
        // Structured reports that came from elsewhere belong to a patient, whether or not their study is a case.
        "CREATE TABLE kept_reports (sop_uid TEXT PRIMARY KEY, sop_class TEXT NOT NULL, series_uid TEXT NOT NULL,"
        " study_uid TEXT NOT NULL, study_date TEXT NOT NULL, patient_id TEXT NOT NULL, patient TEXT NOT NULL,"
        " study TEXT NOT NULL, sha256 TEXT NOT NULL, file TEXT NOT NULL, created TEXT NOT NULL)",
        "CREATE INDEX kept_reports_patient ON kept_reports (patient_id)",
        "CREATE TABLE comparisons (case_id TEXT NOT NULL, finding_id TEXT NOT NULL, report_uid TEXT NOT NULL,"
        " prior_uid TEXT NOT NULL, content TEXT NOT NULL, PRIMARY KEY (case_id, finding_id, report_uid, prior_uid))",
    },
    {
        // A case that is deleted takes its report along; nothing else does.
        "CREATE TABLE deletions (mark TEXT PRIMARY KEY, case_id TEXT NOT NULL)",
        "DROP TRIGGER report_versions_are_not_deleted",
        "CREATE TRIGGER report_versions_are_not_deleted BEFORE DELETE ON report_versions"
        " WHEN NOT EXISTS (SELECT 1 FROM deletions WHERE case_id = OLD.case_id)"
        " BEGIN SELECT RAISE(ABORT, 'a version of a report never changes'); END",
    },
    {
        // What a modality worklist said of a case.
        "CREATE TABLE orders (case_id TEXT PRIMARY KEY, content TEXT NOT NULL)",
    },
    {
        // By which a server is asked for a commit whose answer did not come; in a file it stays empty.
        "CREATE TABLE commits (name TEXT PRIMARY KEY, at REAL NOT NULL)",
    },
    {
        // Senders take turns, so that none waits for all that another sent.
        "ALTER TABLE jobs ADD COLUMN sender TEXT NOT NULL DEFAULT ''",
        "ALTER TABLE jobs ADD COLUMN turn INTEGER NOT NULL DEFAULT 0",
        "DROP INDEX jobs_waiting",
        "CREATE INDEX jobs_waiting ON jobs (opened DESC, turn, queued) WHERE state = 'queued'",
        "CREATE INDEX jobs_turn ON jobs (turn) WHERE state = 'queued'",
        "CREATE INDEX jobs_sender ON jobs (sender, turn) WHERE state = 'queued'",
    },
    {
        // The SHA-256 of each DICOM object of a version, by its file's name: JSON; empty where none was kept then.
        "ALTER TABLE report_versions ADD COLUMN objects TEXT NOT NULL DEFAULT ''",
    },
};
static_assert(Database::kSchemaVersion == 10, "add a migration for every version");

/// The connection broke before the server had committed.
struct NotCommitted {};

}  // namespace

const std::vector<std::vector<const char*>>& schemaMigrations()
{
    return kMigrations;
}

Error databaseIsLost(const std::string& where)
{
    return {ErrorCode::database, "the store's folder holds cases or objects, and its database is gone or empty", where,
            "nothing was made or changed; put the database back, or let 'vicon restore' make a store of the last "
            "backup in another folder"};
}

std::string inOneLine(const std::string& text)
{
    std::string line;
    for (const char c : text)
        if (c != '\n' && c != '\r' && c != '\t')
            line += c;
        else if (!line.empty() && line.back() != ' ')
            line += ' ';
    while (!line.empty() && line.back() == ' ')
        line.pop_back();
    return line;
}

Database::Database(const std::string& where, bool may_be_new)
    : where_(where), engine_(isServerAddress(where) ? makePostgresql(where) : makeSqlite(where))
{
    try {
        session_ = engine_->connect();
        engine_->prepare(*session_);
        migrate(may_be_new);
    } catch (const soci::soci_error& e) {
        throw engine_->cannotBeOpened(e);
    }
}

Database::~Database() = default;

void Database::migrate(bool may_be_new)
{
    const int found = engine_->schemaVersion(*session_);
    if (found == kSchemaVersion)
        return;
    if (found == 0 && !may_be_new)
        throw databaseIsLost(isServerAddress(where_) ? "store.database" : where_);
    writing_ = true;
    try {
        engine_->beginMigration(*session_);
        int version = engine_->schemaVersion(*session_);  // again: another process may have migrated meanwhile
        if (version > kSchemaVersion)
            throw Error(ErrorCode::database,
                        "the store has schema version " + std::to_string(version) + ", this VICON knows up to " +
                            std::to_string(kSchemaVersion),
                        {}, "use the newer VICON that wrote it");
        for (; version < kSchemaVersion; ++version)
            for (const char* statement : kMigrations[std::size_t(version)])
                *session_ << engine_->schemaStatement(statement);
        engine_->setSchemaVersion(*session_, kSchemaVersion);
        *session_ << "COMMIT";
    } catch (...) {
        rollBack();
        throw;
    }
    writing_ = false;
}

soci::session& Database::session()
{
    if (!writing_ && engine_->isLost(*session_))
        reconnect();
    return *session_;
}

void Database::readAgain(const std::function<void(soci::session&)>& work)
{
    for (int run = 1;; ++run) {
        try {
            return work(session());
        } catch (const soci::soci_error& e) {
            if (writing_)  // for the transaction to deal with
                throw;
            if (run == kMostRuns || !engine_->isLost(*session_))
                throw engine_->refusal(e, session_.get());
        } catch (const nlohmann::json::exception&) {  // its words would hold the row's
            throw engine_->damaged();
        } catch (const std::bad_cast&) {
            throw engine_->damaged();
        }
    }
}

void Database::reconnect()
{
    const auto end = std::chrono::steady_clock::now() + patience_;
    while (true) {
        try {
            session_->reconnect();
            engine_->prepare(*session_);
            return;
        } catch (const soci::soci_error& e) {
            if (std::chrono::steady_clock::now() > end)
                throw engine_->cannotBeOpened(e);
            std::this_thread::sleep_for(kBetweenTries);
        }
    }
}

void Database::requireReadable()
{
    read([&](soci::session& sql) { engine_->readBeginnings(sql); });
}

std::string Database::damage()
{
    try {
        return engine_->damage(session());
    } catch (const soci::soci_error& e) {
        return engine_->reasonOf(e);
    }
}

std::string Database::version()
{
    try {
        return engine_->version(session());
    } catch (const soci::soci_error& e) {
        throw engine_->refusal(e, session_.get());
    }
}

void Database::write(const std::function<void(soci::session&)>& work)
{
    transact(work, Writers::one);
}

void Database::writeRows(const std::function<void(soci::session&)>& work)
{
    transact(work, Writers::several);
}

void Database::transact(const std::function<void(soci::session&)>& work, Writers writers)
{
    if (writing_)
        throw Error(ErrorCode::internal, "a transaction within a transaction");
    const int runs = writers == Writers::several ? kMostRuns : 1;
    for (int run = 1;; ++run) {
        try {
            try {
                begin(writers);
                work(*session_);
                commit();
            } catch (...) {  // also of begin(): the next change must find none begun
                rollBack();
                throw;
            }
            return;
        } catch (const soci::soci_error& e) {
            const bool gave_way = engine_->gaveWay(e);
            if (run == runs || !(gave_way || engine_->isLost(*session_)))
                throw engine_->refusal(e, session_.get());
            if (gave_way)  // and lets the other go first
                std::this_thread::sleep_for(kBetweenTries);
        } catch (const NotCommitted&) {
            if (run == runs)
                throw engine_->connectionBroke();
        }
    }
}

/// Over a connection that broke while it idled as well: nothing was done yet.
void Database::begin(Writers writers)
{
    const auto begin = [&] {
        writers == Writers::one ? engine_->beginAlone(*session_) : engine_->beginBesideOthers(*session_);
    };
    if (engine_->isLost(*session_))
        reconnect();
    writing_ = true;
    try {
        begin();
    } catch (const soci::soci_error&) {
        if (!engine_->isLost(*session_))
            throw;
        reconnect();
        begin();
    }
}

void Database::commit()
{
    const std::string name = engine_->transactionName(*session_);
    try {
        *session_ << "COMMIT";
    } catch (const soci::soci_error&) {
        if (name.empty() || !engine_->isLost(*session_))
            throw;
        writing_ = false;
        if (!wasCommitted(name))
            throw NotCommitted();
    }
    writing_ = false;
}

/// It is asked over a new connection, which may break as well.
bool Database::wasCommitted(const std::string& name)
{
    while (true) {
        reconnect();
        try {
            return engine_->wasCommitted(*session_, name);
        } catch (const soci::soci_error&) {
            if (!engine_->isLost(*session_))
                throw;
        }
    }
}

void Database::rollBack()
{
    try {
        if (std::exchange(writing_, false) && !engine_->isLost(*session_))
            *session_ << "ROLLBACK";
    } catch (const soci::soci_error&) {  // it has rolled back by itself: SQLite on a full disk, a server that broke off
    }
}

}  // namespace vicon
