#pragma once

#include <optional>

#include "segment/body.h"
#include "vicon/steps/organ.h"

namespace vicon::steps {

/// The widest ball of a cavity's densities, and the widest beside it that nothing of those densities joins to it.
struct SeedBall {
    Point3 middle_mm;
    double radius_mm = 0;
    std::optional<Point3> other_mm;  ///< of a ball nearly as wide
};

/// The widest ball of the wanted radius and densities near the body's midline; nothing when there is none. To the
/// body's coarse voxels.
std::optional<SeedBall> findSeedBall(const Body& body, const OrganOptions& options, Progress& progress);

/// Leaves of a cavity the largest part that hangs together by faces: what an opening cut off is not flown in.
void keepLargestPart(InsideVolume& mask);

}  // namespace vicon::steps
