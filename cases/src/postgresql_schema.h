#pragma once

#include <string>

namespace vicon {

/// A statement of the schema, which is written in SQLite's words, in PostgreSQL's: types, triggers, and the column
/// `rowid` that SQLite's tables have of themselves. Text is ordered byte by byte, as SQLite does.
std::string inPostgresql(const std::string& statement);

}  // namespace vicon
