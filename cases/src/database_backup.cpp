#include "database_backup.h"

#include <soci/soci.h>
#include <soci/sqlite3/soci-sqlite3.h>

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

/// Source: sqlite.org/backup.html. Over a connection of its own: one that writes cannot be copied from.
void copyAll(const std::string& from, const std::filesystem::path& to)
{
    constexpr int kAllPages = -1;
    const Handle source = open(from), copy = open(to);
    sqlite_api::sqlite3_backup* backup = sqlite_api::sqlite3_backup_init(copy.get(), "main", source.get(), "main");
    if (!backup)
        throw failure(sqlite_api::sqlite3_errmsg(copy.get()), to);
    const int copied = sqlite_api::sqlite3_backup_step(backup, kAllPages);
    const int finished = sqlite_api::sqlite3_backup_finish(backup);
    if (copied != SQLITE_DONE || finished != SQLITE_OK)
        throw failure(sqlite_api::sqlite3_errstr(copied == SQLITE_DONE ? finished : copied), to);
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

void dumpServersDatabase(const std::string& address, const std::filesystem::path& file)
{
    replaceFile(file, [&](const std::filesystem::path& temporary) {
        const ProgramEnd end = runProgram(
            {"pg_dump", "--format=custom", "--no-owner", "--no-password", "--file=" + temporary.string(), address});
        if (end.exit_code != 0)
            throw failure(reasonOf(end, "pg_dump"), file);
    });
}

}  // namespace

std::string backupNameOf(const std::string& address)
{
    return address.empty() ? "vicon.db" : "vicon.pgdump";
}

void restoreServersDatabase(const std::string& address, const std::filesystem::path& file)
{
    const auto engine = makePostgresql(address);
    try {
        if (engine->schemaVersion(*engine->connect()) != 0)
            throw Error(ErrorCode::wrong_use, "a store is restored into an empty database", "store.database",
                        "name another one");
    } catch (const soci::soci_error& e) {
        throw engine->cannotBeOpened(e);
    }
    const ProgramEnd end = runProgram({"pg_restore", "--no-owner", "--no-password", "--exit-on-error",
                                       "--single-transaction", "--dbname=" + address, file.string()});
    if (end.exit_code != 0)
        throw Error(ErrorCode::database, "the database cannot be restored (" + reasonOf(end, "pg_restore") + ")",
                    "store.database", "see whether it is empty, and as new as the one that was backed up");
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

void backUpDatabase(Database& database, const std::filesystem::path& file)
{
    if (isServerAddress(database.where()))
        return dumpServersDatabase(database.where(), file);
    soci::session& sql = database.session();
    // Not a dynamic cast: the library keeps the type's description to itself.
    const auto* sqlite = static_cast<const soci::sqlite3_session_backend*>(sql.get_backend());
    const std::string source = sqlite_api::sqlite3_db_filename(sqlite->conn_, "main");
    replaceFile(file, [&](const std::filesystem::path& temporary) { copyAll(source, temporary); });
}

}  // namespace vicon
