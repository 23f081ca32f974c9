#pragma once

#include "vicon/core/volume.h"

namespace vicon::steps {

/// A mask on another grid: 1 for the voxels whose centre lies where, linearly interpolated, at least half is in the
/// mask. Only the part of the grid that the mask reaches, with a voxel around; of size 0 where it reaches none.
/// @param mask 0 or 1; axes in any order and direction
InsideVolume onGrid(const InsideVolume& mask, const Grid& grid);

}  // namespace vicon::steps
