#pragma once

#include <vector>

#include "vicon/core/progress.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

/// Cuts the lumen through: takes out its whole cross-section at a place, 3 mm thick, wherever in the cross-section the
/// point lies (up to 3 mm beside the lumen). The cross-section is the smallest of the plane ones through the lumen's
/// middle beside the point. Returns the voxels of lumen on both sides of the cut; none where there is no lumen.
std::vector<Index3> cutAcross(InsideVolume& labels, Point3 point, Progress& progress);

}  // namespace vicon::steps
