#pragma once

#include <cstdint>

#include "vicon/core/volume.h"

namespace vicon::steps {

/// Keeps, of the voxels that are 1, those in a cube of 2 x 2 x 2 of them: the morphological opening by it.
/// @param voxels 0 and 1
void openByCubes(Volume<std::uint8_t>& voxels);

}  // namespace vicon::steps
