#pragma once

#include <vector>

#include "vicon/core/skeleton.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

/// How much lumen belongs to each millimetre of the skeleton.
struct LumenProfile {
    std::vector<double> volume_mm3;  ///< gas and fluid; [n] is stations n to n + 1 mm
    std::vector<double> fluid_mm3;
    double unreached_mm3 = 0;  ///< of parts that do not hang together with the skeleton
};

/// Floods the lumen from all stations at once, on blocks of 2 x 2 x 2 voxels through faces; bridges are no source.
LumenProfile profileOf(const InsideVolume& inside, const Skeleton& skeleton);

}  // namespace vicon::steps
