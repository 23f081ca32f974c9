#pragma once

#include <filesystem>
#include <string>

#include "vicon/cases/database.h"

namespace vicon {

/// In the folder of a store whose database lies on a server: the name that both have for it.
inline constexpr const char* kServersDatabase = "database.id";

/// What the file is called that backUpDatabase() makes of a database at this address; empty: of SQLite.
std::string backupNameOf(const std::string& address);

/// Writes the database, as it is at this moment, into a file of its own, one of a server by its pg_dump; others may
/// work on it meanwhile. Also within a write transaction of this connection. Throws Error{database}.
void backUpDatabase(Database& database, const std::filesystem::path& file);

/// Throws Error{database} for a damaged one of SQLite: its backup would be worth nothing. A server's is read by its
/// pg_dump, which says itself what it cannot read.
void requireUndamaged(Database& database);
/// The same of a file that backUpDatabase() made.
void requireUndamagedCopy(const std::filesystem::path& file);

/// Fills an empty database of a server with what a file of backUpDatabase() holds, by pg_restore. Throws
/// Error{database}; the database is as empty as before then. Throws Error{wrong_use} where it is not empty.
void restoreServersDatabase(const std::string& address, const std::filesystem::path& file);

}  // namespace vicon
