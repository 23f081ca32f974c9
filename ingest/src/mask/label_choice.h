#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace vicon::ingest {

/// The label that is meant: the one asked for, else the only one. Throws Error{bad_input} where there is none at all,
/// Error{wrong_use} where there are several and nobody chose, or the chosen one is not among them; both list them.
/// @param labels what each is called; empty where it has no name
std::int64_t chooseLabel(const std::map<std::int64_t, std::string>& labels, std::optional<int> asked,
                         const std::filesystem::path& file);

}  // namespace vicon::ingest
