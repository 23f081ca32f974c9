#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"

namespace vicon::support {

/// Whether this program was started by tests/support/with-postgresql, so that its stores lie in PostgreSQL.
bool usesPostgresql();

/// A store in this folder: with SQLite, or in a schema of its own of the server that this program runs beside.
StorePlace storePlace(const std::filesystem::path& folder);

/// Stops the server, starts it, restarts it: arguments of pg_ctl.
void tellServer(const std::string& arguments);

/// As an earlier VICON left it: with that version of the schema, and what these statements put into it.
StorePlace storeOfVersion(int version, const std::filesystem::path& folder,
                          const std::vector<std::string>& statements = {});

}  // namespace vicon::support
