#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "vicon/core/bridge.h"
#include "vicon/core/geometry.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

/// A connected part of the lumen, gas and fluid together.
struct LumenPiece {
    Point3 rectal_end_mm;  ///< inside the lumen, near the tip on the rectal side
    Point3 caecal_end_mm;  ///< inside the lumen, near the tip on the caecal side
    double volume_ml = 0;  ///< gas and fluid
    double fluid_ml = 0;
    double length_mm = 0;  ///< from tip to tip along the middle of the lumen, as a chain of voxels: a few per cent long
    double max_radius_mm = 0;  ///< of the largest inscribed sphere
};

/// What the skeleton step needs to know besides inside.mha.
struct LumenPlan {
    std::vector<LumenPiece> pieces;  ///< in anatomical order from the rectum
    std::vector<Bridge> bridges;     ///< bridges[n] joins pieces n and n + 1
};

nlohmann::json toJson(const LumenPlan& plan);
/// Throws Error{bad_input} when a key is missing or of the wrong type.
LumenPlan lumenPlanFromJson(const nlohmann::json& json);

/// The plan for a mask without a scan: its largest connected part, whose lower end (towards the feet) counts as rectal.
/// No pieces when the mask is empty.
LumenPlan planForMask(const InsideVolume& inside);

}  // namespace vicon::steps
