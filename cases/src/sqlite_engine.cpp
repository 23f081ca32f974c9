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

    Error refusal(const soci::soci_error& e, soci::session*) override;
    Error connectionBroke() override { return {ErrorCode::internal, "a file has no connection"}; }
    Error cannotBeOpened(const soci::soci_error& e) override
    {
        // SQLite has one word for all that the system may say.
        const bool may_write = ::access(folderOf(file_).c_str(), W_OK | X_OK) == 0;
        const std::string why = may_write ? e.what() : std::strerror(errno);
        return {ErrorCode::database, "database cannot be opened (" + why + ")", file_,
                "check that the folder is yours, on a local disk, and not full"};
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

Error Sqlite::refusal(const soci::soci_error& e, soci::session*)
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

}  // namespace

std::unique_ptr<DatabaseEngine> makeSqlite(const std::string& file)
{
    return std::make_unique<Sqlite>(file);
}

}  // namespace vicon
