#include <fcntl.h>
#include <soci/sqlite3/soci-sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "database_engine.h"
#include "vicon/core/file_modes.h"

namespace vicon {
namespace {

constexpr int kBusyTimeoutSeconds = 60;
constexpr std::size_t kMostTables = 100;

std::filesystem::path folderOf(const std::filesystem::path& file)
{
    return file.has_parent_path() ? file.parent_path() : ".";
}

/// The folder of a database, by a name without any sign that a connection string reads in its own way. SQLite finds the
/// place behind it, and keeps that.
class Folder {
public:
    explicit Folder(const std::filesystem::path& file)
        : descriptor_(::open(folderOf(file).c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC))
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

/// Nobody else than fileModeIn() says may read the database, at no moment. SQLite gives its other files the same mode.
/// The file is made without being opened: closing it again would drop the locks of every connection that this process
/// has to it, and another program would delete the log under them (sqlite.org/howtocorrupt.html, section 2.2).
void createPrivately(const std::filesystem::path& file)
{
    const mode_t mode = fileModeIn(file.parent_path());
    ::mknod(file.c_str(), S_IFREG | mode, 0);  // that it is there, or cannot be made, SQLite finds
    ::chmod(file.c_str(), mode);
}

int resultOf(const soci::soci_error& e)
{
    const auto* sqlite = dynamic_cast<const soci::sqlite3_soci_error*>(&e);
    return sqlite ? sqlite->result() & 0xff : SQLITE_OK;  // the rest of it tells kinds of the same trouble apart
}

bool isDamage(const soci::soci_error& e)
{
    return resultOf(e) == SQLITE_CORRUPT || resultOf(e) == SQLITE_NOTADB;
}

class Sqlite : public DatabaseEngine {
public:
    explicit Sqlite(std::string file) : file_(std::move(file)) {}

    std::unique_ptr<soci::session> connect() override
    {
        const Folder folder(file_);
        createPrivately(file_);
        return std::make_unique<soci::session>(
            soci::sqlite3, "dbname=" + folder.name(file_) + " timeout=" + std::to_string(kBusyTimeoutSeconds));
    }
    void prepare(soci::session& sql) override
    {
        sql << "PRAGMA journal_mode = WAL";
        sql << "PRAGMA synchronous = FULL";
        sql << "PRAGMA foreign_keys = ON";
    }
    bool isLost(soci::session&) override { return false; }

    int schemaVersion(soci::session& sql) override
    {
        int version = 0;
        sql << "PRAGMA user_version", soci::into(version);
        return version;
    }
    void setSchemaVersion(soci::session& sql, int version) override
    {
        sql << "PRAGMA user_version = " + std::to_string(version);
    }
    void beginMigration(soci::session& sql) override { beginAlone(sql); }
    std::string schemaStatement(const std::string& statement) override { return statement; }

    void beginAlone(soci::session& sql) override { sql << "BEGIN IMMEDIATE"; }
    void beginBesideOthers(soci::session& sql) override { beginAlone(sql); }
    std::string transactionName(soci::session&) override { return {}; }
    bool wasCommitted(soci::session&, const std::string&) override { return false; }
    bool gaveWay(const soci::soci_error&) override { return false; }

    std::string reasonOf(const soci::soci_error& e) override;
    Error refusal(const soci::soci_error& e, soci::session*) override;
    Error connectionBroke() override { return {ErrorCode::internal, "a file has no connection"}; }
    Error damaged() override
    {
        return {
            ErrorCode::database, "the database is damaged", file_,
            "stop VICON, move the store's folder away, put the last backup in its place by 'vicon restore', and import"
            " what came since from the old incoming and cases folders"};
    }
    Error cannotBeOpened(const soci::soci_error& e) override
    {
        if (isDamage(e))
            return damaged();
        // SQLite has one word for all that the system may say.
        const bool may_write = ::access(folderOf(file_).c_str(), W_OK | X_OK) == 0;
        const std::string why = may_write ? reasonOf(e) : std::strerror(errno);
        return {ErrorCode::database, "database cannot be opened (" + why + ")", file_,
                "check that the folder is yours, on a local disk, and not full"};
    }

    void readBeginnings(soci::session& sql) override
    {
        std::vector<std::string> tables(kMostTables);
        sql << "SELECT name FROM sqlite_master WHERE type = 'table'", soci::into(tables);
        int row = 0;
        for (const std::string& table : tables)
            sql << "SELECT 1 FROM \"" + table + "\" NOT INDEXED LIMIT 1", soci::into(row);
    }
    std::string version(soci::session& sql) override
    {
        long long by_others = 0, by_this = 0;
        sql << "PRAGMA data_version", soci::into(by_others);
        sql << "SELECT total_changes()", soci::into(by_this);
        return std::to_string(by_others) + "/" + std::to_string(by_this);
    }
    std::string damage(soci::session& sql) override
    {
        std::string found;
        sql << "PRAGMA integrity_check(1)", soci::into(found);
        return found == "ok" ? "" : found;
    }

private:
    std::string file_;
};

/// SOCI begins with its own function's name.
std::string Sqlite::reasonOf(const soci::soci_error& e)
{
    const std::string text = inOneLine(e.get_error_message()), function_ends = ": ";
    const std::size_t end = text.starts_with("sqlite3_") ? text.find(function_ends) : std::string::npos;
    return end == std::string::npos ? text : text.substr(end + function_ends.size());
}

Error Sqlite::refusal(const soci::soci_error& e, soci::session*)
{
    switch (resultOf(e)) {
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
        case SQLITE_READONLY:
            return {ErrorCode::database,
                    "the store's disk is read-only; nothing was saved",
                    {},
                    "see why it is, and try again when it can be written"};
        case SQLITE_CORRUPT:
        case SQLITE_NOTADB:
            return damaged();
        default:
            return {ErrorCode::database,
                    "the database refused (" + reasonOf(e) + ")",
                    {},
                    "check the disk, then run again"};
    }
}

}  // namespace

std::unique_ptr<DatabaseEngine> makeSqlite(const std::string& file)
{
    return std::make_unique<Sqlite>(file);
}

}  // namespace vicon
