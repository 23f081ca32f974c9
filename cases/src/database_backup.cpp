#include "database_backup.h"

#include <soci/soci.h>
#include <soci/sqlite3/soci-sqlite3.h>

#include <algorithm>
#include <memory>

#include "database_engine.h"
#include "run_program.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace vicon {
namespace {

using Handle = std::unique_ptr<sqlite_api::sqlite3, decltype(&sqlite_api::sqlite3_close)>;

Error failure(const std::string& why, const std::filesystem::path& file)
{
    return {ErrorCode::database, "the database cannot be copied (" + why + ")", file.string(),
            "see whether that disk is full or at fault, then try again"};
}

Handle open(const std::string& file)
{
    sqlite_api::sqlite3* opened = nullptr;
    const int result = sqlite_api::sqlite3_open(file.c_str(), &opened);
    Handle handle(opened, &sqlite_api::sqlite3_close);
    if (result != SQLITE_OK)
        throw failure(sqlite_api::sqlite3_errmsg(opened), file);
    return handle;
}

/// Source: sqlite.org/backup.html.
void copyAll(sqlite_api::sqlite3* source, const std::filesystem::path& to)
{
    constexpr int kAllPages = -1;
    const Handle copy = open(to);
    sqlite_api::sqlite3_backup* backup = sqlite_api::sqlite3_backup_init(copy.get(), "main", source, "main");
    if (!backup)
        throw failure(sqlite_api::sqlite3_errmsg(copy.get()), to);
    const int copied = sqlite_api::sqlite3_backup_step(backup, kAllPages);
    const int finished = sqlite_api::sqlite3_backup_finish(backup);
    if (copied != SQLITE_DONE || finished != SQLITE_OK)
        throw failure(sqlite_api::sqlite3_errstr(copied == SQLITE_DONE ? finished : copied), to);
}

/// Over a connection of its own, which reads at this moment and so goes on to see it.
Handle holdSqlite(Database& database)
{
    // Not a dynamic cast: the library keeps the type's description to itself.
    const auto* sqlite = static_cast<const soci::sqlite3_session_backend*>(database.session().get_backend());
    const std::string file = sqlite_api::sqlite3_db_filename(sqlite->conn_, "main");
    Handle held = open(file);
    const int result =
        sqlite_api::sqlite3_exec(held.get(), "BEGIN; SELECT COUNT(*) FROM sqlite_master", nullptr, nullptr, nullptr);
    if (result != SQLITE_OK)
        throw failure(sqlite_api::sqlite3_errstr(result), file);
    return held;
}

/// What a program said first; the lines after it quote rows.
std::string reasonOf(const ProgramEnd& end, const std::string& program)
{
    if (end.exit_code == kNoSuchProgram)
        return program + " is not here; install postgresql-client";
    const std::size_t begin = std::min(end.said.find("error: "), end.said.size());
    const std::string line = end.said.substr(begin, end.said.find('\n', begin) - begin);
    return program + ": " + (line.empty() ? "exit code " + std::to_string(end.exit_code) : line);
}

void dumpServersDatabase(const std::string& address, const std::string& snapshot, const std::filesystem::path& file)
{
    replaceFile(file, [&](const std::filesystem::path& temporary) {
        const ProgramEnd end = runProgram({"pg_dump", "--format=custom", "--no-owner", "--no-password",
                                           "--snapshot=" + snapshot, "--file=" + temporary.string(), address});
        if (end.exit_code != 0)
            throw failure(reasonOf(end, "pg_dump"), file);
    });
}

/// What a database of a server holds that a dump may bring, as the statements that drop it.
std::vector<std::string> droppingStatements(soci::session& sql)
{
    constexpr const char* kQueries[] = {
        "SELECT 'DROP TABLE IF EXISTS ' || quote_ident(schemaname) || '.' || quote_ident(tablename) || ' CASCADE'"
        " FROM pg_tables WHERE schemaname !~ '^pg_' AND schemaname <> 'information_schema'",
        "SELECT 'DROP FUNCTION IF EXISTS ' || CAST(CAST(p.oid AS regprocedure) AS text) || ' CASCADE' FROM pg_proc p"
        " JOIN pg_namespace n ON n.oid = p.pronamespace WHERE n.nspname !~ '^pg_' AND n.nspname <> 'information_schema'"
        " AND p.prokind = 'f'",
        "SELECT 'DROP SCHEMA IF EXISTS ' || quote_ident(nspname) || ' CASCADE' FROM pg_namespace"
        " WHERE nspname !~ '^pg_'",
    };
    std::vector<std::string> statements;
    for (const char* query : kQueries) {
        const soci::rowset<std::string> found = (sql.prepare << query);
        statements.insert(statements.end(), found.begin(), found.end());
    }
    return statements;
}

}  // namespace

std::string backupNameOf(const std::string& address)
{
    return address.empty() ? "vicon.db" : "vicon.pgdump";
}

FilledDatabase::FilledDatabase(const std::string& address, const std::filesystem::path& file) : address_(address)
{
    const auto engine = makePostgresql(address);
    try {
        const auto sql = engine->connect();
        if (engine->schemaVersion(*sql) != 0)
            throw Error(ErrorCode::wrong_use, "a store is restored into an empty database", "store.database",
                        "name another one");
        there_before_ = droppingStatements(*sql);
    } catch (const soci::soci_error& e) {
        throw engine->cannotBeOpened(e);
    }
    const ProgramEnd end = runProgram({"pg_restore", "--no-owner", "--no-password", "--exit-on-error",
                                       "--single-transaction", "--dbname=" + address, file.string()});
    if (end.exit_code != 0)
        throw Error(ErrorCode::database, "the database cannot be restored (" + reasonOf(end, "pg_restore") + ")",
                    "store.database", "see whether it is empty, and as new as the one that was backed up");
}

FilledDatabase::~FilledDatabase()
{
    if (kept_)
        return;
    try {
        const auto sql = makePostgresql(address_)->connect();
        *sql << "SET client_min_messages = 'warning'";  // that more goes with a table is no news
        for (const std::string& statement : droppingStatements(*sql))
            if (std::ranges::find(there_before_, statement) == there_before_.end())
                *sql << statement;
    } catch (const std::exception&) {  // a server that is away: the next restore says that it is not empty
    }
}

void requireUndamaged(Database& database)
{
    if (!isServerAddress(database.where()) && !database.damage().empty())
        throw makeSqlite(database.where())->damaged();
}

void requireUndamagedCopy(const std::filesystem::path& file)
{
    if (file.filename() != backupNameOf({}))
        return;
    const Handle copy = open(file);
    const auto says_ok = [](void* is_ok, int, char** values, char**) {
        *static_cast<bool*>(is_ok) = values[0] == std::string("ok");
        return 0;
    };
    bool is_ok = false;
    // Alone with it: no room is needed for what several share.
    const int result = sqlite_api::sqlite3_exec(
        copy.get(), "PRAGMA locking_mode = EXCLUSIVE; PRAGMA integrity_check(1)", says_ok, &is_ok, nullptr);
    if (result != SQLITE_OK || !is_ok)
        throw failure(result == SQLITE_OK ? "it is damaged" : sqlite_api::sqlite3_errstr(result), file);
}

struct DatabaseSnapshot::Held {
    Handle sqlite{nullptr, &sqlite_api::sqlite3_close};
    std::unique_ptr<soci::session> server;
    std::string address, name;
};

DatabaseSnapshot::DatabaseSnapshot(Database& database) : held_(std::make_unique<Held>())
{
    if (!isServerAddress(database.where())) {
        held_->sqlite = holdSqlite(database);
        return;
    }
    held_->address = database.where();
    const auto engine = makePostgresql(held_->address);
    try {
        held_->server = engine->connect();
        *held_->server << "BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY";
        *held_->server << "SET LOCAL idle_in_transaction_session_timeout = 0";  // it idles while the dump is made
        *held_->server << "SELECT pg_export_snapshot()", soci::into(held_->name);
    } catch (const soci::soci_error& e) {
        throw engine->refusal(e, held_->server.get());
    }
}

DatabaseSnapshot::~DatabaseSnapshot() = default;

void DatabaseSnapshot::writeTo(const std::filesystem::path& file)
{
    if (held_->server)
        return dumpServersDatabase(held_->address, held_->name, file);
    replaceFile(file, [&](const std::filesystem::path& temporary) { copyAll(held_->sqlite.get(), temporary); });
}

}  // namespace vicon
