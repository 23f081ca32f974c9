#pragma once

#include <cstddef>
#include <vector>

#include "vicon/core/volume.h"

namespace vicon::steps {

/// Takes voxels out of the lumen, and what crumbs are left of it. If that would part a piece, puts them back as fluid:
/// better a wall half a voxel too far out than a colon in two.
/// @param taken voxels of fluid, outside already
/// @param pieces how many connected parts the lumen has
void trimLumen(const std::vector<std::size_t>& taken, int pieces, InsideVolume& inside);

}  // namespace vicon::steps
