#pragma once

#include <vector>

#include "segment/body.h"
#include "vicon/steps/organ.h"

namespace vicon::steps {

/// A tube along the body's axis: the middle of its round section in each axial slice, from head to feet.
struct SeedTube {
    std::vector<Point3> middle_mm;
    double radius_mm = 0;  ///< mean
    double length_mm = 0;
};

/// The longest tube of the wanted radius and densities near the body's midline; no points when there is none.
SeedTube findSeedTube(const HuVolume& volume, const Body& body, const OrganOptions& options, Progress& progress);

}  // namespace vicon::steps
