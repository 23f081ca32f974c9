#pragma once

#include <cstdint>
#include <vector>

#include "vicon/steps/tissue.h"

namespace vicon::steps {

/// Evens out what noise does to the wall: in the wall's blurred edge each voxel becomes the mean of those around it in
/// the plane across the fraction's slope. So the wall stays as sharp as it is, and edges, folds and polyps keep their
/// place. Where gas and fluid are both near, this is done to all voxels: there the model of three contents errs, from
/// voxel to voxel, by more than noise.
/// @param of_three where gas and fluid are both near, not 0; empty: nowhere
void smoothAlongWall(const std::vector<std::uint8_t>& of_three, TissueVolume& tissue);

}  // namespace vicon::steps
