#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace soci {
class session;
}

namespace vicon {

/// The state of a store: one connection to STORE/vicon.db, migrated to this VICON's schema version.
/// One object serves one thread at a time.
class Database {
public:
    static constexpr int kSchemaVersion = 3;

    /// Opens (and creates) the database. Throws Error{database} when it cannot, or when its schema is newer than
    /// this VICON knows.
    explicit Database(const std::filesystem::path& file);
    ~Database();
    Database(const Database&) = delete;
    Database& operator=(const Database&) = delete;

    soci::session& session() { return *session_; }

    /// The same again as long as nobody changed anything, over this connection or another; to be compared with what
    /// this object said before.
    std::string version();

    /// Reads all of it: what is damaged, in SQLite's words; empty where nothing is.
    std::string damage();

    /// Runs `work` in one write transaction (BEGIN IMMEDIATE), rolled back when it throws. Database errors become
    /// Error{database}.
    void write(const std::function<void(soci::session&)>& work);

private:
    void migrate();
    std::unique_ptr<soci::session> session_;
};

}  // namespace vicon
