#pragma once

#include "vicon/core/volume.h"

namespace vicon::steps {

/// Whether one of the six neighbours of a voxel lies on the other side of the mask; beyond the grid is outside.
bool besideOther(const InsideVolume& inside, Index3 v);

}  // namespace vicon::steps
