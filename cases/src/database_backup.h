#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "vicon/cases/database.h"

namespace vicon {

/// In the folder of a store whose database lies on a server: the name that both have for it.
inline constexpr const char* kServersDatabase = "database.id";

/// What the file is called that backUpDatabase() makes of a database at this address; empty: of SQLite.
std::string backupNameOf(const std::string& address);

/// A database as it is at one moment, for as long as the object lives; others go on to change it.
class DatabaseSnapshot {
public:
    /// Also within a write transaction of this connection that has changed nothing yet. Throws Error{database}.
    explicit DatabaseSnapshot(Database& database);
    ~DatabaseSnapshot();
    /// Writes it into a file of its own, a server's by its pg_dump. Throws Error{database}.
    void writeTo(const std::filesystem::path& file);

private:
    struct Held;
    std::unique_ptr<Held> held_;
};

/// Throws Error{database} for a damaged one of SQLite: its backup would be worth nothing. A server's is read by its
/// pg_dump, which says itself what it cannot read.
void requireUndamaged(Database& database);
/// The same of a file that DatabaseSnapshot::writeTo() made.
void requireUndamagedCopy(const std::filesystem::path& file);

/// An empty database of a server, filled with what a file of DatabaseSnapshot::writeTo() holds; as empty as before when
/// the object goes, unless it is kept.
class FilledDatabase {
public:
    /// By pg_restore. Throws Error{database}; Error{wrong_use} where it is not empty.
    FilledDatabase(const std::string& address, const std::filesystem::path& file);
    ~FilledDatabase();
    FilledDatabase(const FilledDatabase&) = delete;
    FilledDatabase& operator=(const FilledDatabase&) = delete;
    void keep() { kept_ = true; }

private:
    std::string address_;
    std::vector<std::string> there_before_;  ///< statements that would drop it
    bool kept_ = false;
};

}  // namespace vicon
