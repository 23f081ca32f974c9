#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "vicon/core/options.h"
#include "vicon/core/progress.h"
#include "vicon/core/quantity.h"
#include "vicon/steps/subdivide.h"

namespace vicon::pipeline {

/// A way to divide a scan's lumen, and how even the cells are that it makes.
struct SubdivisionRow {
    steps::SubdivideOptions options;
    nlohmann::json statistics;  ///< as in subdivision.json: segments, triangles a cell
};

/// The thesis' Table 2 for a scan: method "flood", then method "thesis" by each measure of a segment's size with each
/// measure of a portal's effectiveness; all else as configured. The stored lumen is divided anew for each, and nothing
/// is changed. Of an organ that branches: "flood" alone, for planes across one path do not part branches.
/// Throws Error{not_found} where the scan has not been through the pipeline.
/// @param scan_folder of the scan
/// @param quantity of its volume
std::vector<SubdivisionRow> subdivisionTable(const std::filesystem::path& scan_folder, const Config& config,
                                             Quantity quantity, Progress& progress);

}  // namespace vicon::pipeline
