#pragma once

#include "vicon/core/progress.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

/// Distance from boundary: for every inside voxel the Euclidean distance in mm from its centre to the wall, which lies
/// half a voxel (half the smallest spacing) before the nearest outside voxel's centre; 0 outside. What lies beyond the
/// grid counts as outside. Exact: no nearer outside voxel exists. 1-Lipschitz between voxel centres.
/// Same grid as `inside`. The result does not depend on the number of threads.
FieldVolume wallDistance(const InsideVolume& inside, Progress& progress);

}  // namespace vicon::steps
