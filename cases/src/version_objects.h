#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/report_versions.h"

namespace vicon {

/// SHA-256 of the DICOM objects of a version, by the names of their files.
using ObjectHashes = std::map<std::string, std::string>;

/// What the column "objects" of "report_versions" says; nothing where it is empty: none were kept then.
std::optional<ObjectHashes> objectHashesFrom(const std::string& column);
ObjectHashes hashesOf(const std::vector<std::filesystem::path>& files);
/// What of a version's objects is not as it was kept, in a line; empty where all of it is.
std::string faultOfObjects(const ReportVersion& version);
/// Copies them into the folder of the version, in place of what a kill left there of another try at it. Throws
/// Error{store}.
void putObjects(const ReportVersion& version, const std::vector<std::filesystem::path>& files);

}  // namespace vicon
