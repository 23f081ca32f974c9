#pragma once

#include <filesystem>
#include <string>

#include "vicon/cases/content_tree.h"

namespace vicon::ingest {

/// Whether objects of this class may hold measurements of TID 1500.
bool isMeasurementClass(const std::string& sop_class);

/// Reads a structured report of any maker. What is there is taken; what cannot be read is said, and costs only itself.
/// The structure of the file is followed before a library sees it, as of every file that comes in.
/// @throws Error{bad_input} for what is no structured report, or is damaged
ContentDocument readStructuredReport(const std::filesystem::path& file);

}  // namespace vicon::ingest
