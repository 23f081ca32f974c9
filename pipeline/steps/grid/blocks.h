#pragma once

#include <cstdint>

#include "vicon/core/volume.h"

namespace vicon::steps {

/// The mean density of each block of `factor` voxels a side; blocks at the upper ends may be smaller.
HuVolume meanOfBlocks(const HuVolume& volume, int factor);

/// The minimum over 3 x 3 x 3 voxels, as far as the grid goes.
Volume<std::uint8_t> erodedByBox(const Volume<std::uint8_t>& mask);

/// The maximum over 3 x 3 x 3 voxels, as far as the grid goes.
Volume<std::uint8_t> dilatedByBox(const Volume<std::uint8_t>& mask);

}  // namespace vicon::steps
