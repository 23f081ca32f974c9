#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace vicon::scan_files {

/// Writes scan.json into a scan's folder: what the database holds of the scan, for everyone who reads files.
void writeDescription(const std::filesystem::path& scan_folder, const nlohmann::json& description);

/// Whether scan.json is there and says just this.
bool isDescribedBy(const std::filesystem::path& scan_folder, const nlohmann::json& description);

/// scan.json of a scan's folder, an object; an empty one where there is none. Throws Error{bad_input}.
nlohmann::json readDescription(const std::filesystem::path& scan_folder);

}  // namespace vicon::scan_files
