#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "vicon/core/subdivision.h"

namespace vicon::scan_files {

/// Writes and reads `subdivision.json`. Reading throws Error{not_found} or Error{bad_input}.
void writeSubdivision(const std::filesystem::path& file, const Subdivision& subdivision);
Subdivision readSubdivision(const std::filesystem::path& file);

}  // namespace vicon::scan_files
