#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "vicon/core/geometry.h"
#include "vicon/core/options.h"

namespace vicon::pipeline {

/// What a person says about the lumen of one scan, as points in LPS mm. Kept as `corrections.json` in the scan's
/// folder; the step `segment` takes it together with segment.add, .cut and .drop of the configuration.
struct Corrections {
    std::vector<Point3> add;   ///< the gas or fluid here belongs to the colon
    std::vector<Point3> cut;   ///< the lumen is cut here; the smaller part is dropped
    std::vector<Point3> drop;  ///< the piece here does not belong to the colon

    bool empty() const { return add.empty() && cut.empty() && drop.empty(); }
};

/// The corrections of a scan; none when there is no such file. Throws Error{bad_input} when it cannot be understood.
Corrections readCorrections(const std::filesystem::path& scan_folder);
/// Replaces a scan's corrections; none removes the file. Throws Error{store}.
void writeCorrections(const std::filesystem::path& scan_folder, const Corrections& corrections);
/// {"add": [[x, y, z], ...], "cut": ..., "drop": ...}
nlohmann::json toJson(const Corrections& corrections);

/// The configuration with a scan's corrections added to segment.add, .cut and .drop; the same one when there are none.
Config withCorrections(Config config, const Corrections& corrections);

}  // namespace vicon::pipeline
