#pragma once

#include "vicon/core/volume.h"

namespace vicon::steps {

/// Label of fluid that lies within the rim's width of the wall, while pools are told from what they leak into.
inline constexpr std::uint8_t kRim = 3;

/// How many layers of voxels are as thick as `width_mm`.
int rimLayers(const Grid& grid, double width_mm);

/// Relabels fluid near the wall as kRim: pools, bowel loops and bones that touch through a small hole in a thin wall
/// then fall apart. The ends of the scan are no wall.
void markFluidRim(InsideVolume& labels, int layers);

/// Gives the rim back to the gas and fluid that are left, `layers` + 1 voxels deep, and clears the rest of it.
void restoreFluidRim(InsideVolume& labels, int layers);

}  // namespace vicon::steps
