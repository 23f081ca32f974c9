#pragma once

#include "vicon/core/volume.h"

namespace vicon::phantom {

/// Euler number (pieces - tunnels + cavities) of the voxels that are not 0, where voxels that share a face, an edge or
/// a corner are connected.
int eulerNumber26(const InsideVolume& volume, Index3 low, std::array<int, 3> size);
/// The same where only voxels that share a face are connected.
int eulerNumber6(const InsideVolume& volume, Index3 low, std::array<int, 3> size);

}  // namespace vicon::phantom
