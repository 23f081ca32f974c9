#pragma once

#include "grid/wall_field.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

/// Moves the wall under fluid to half-way between tissue and the pool's own density, where the surface is contoured:
/// the flood went down to half-way of the faintest pool that it reached, which also leaves holes in thin walls. Takes
/// away only: two layers of voxels at most, none beside gas, nothing that would part a piece.
/// @param inside the chosen pieces, gas and fluid; on the lattice of `volume`
/// @param pieces how many connected parts `inside` has
void settleFluidWall(const HuVolume& volume, const WallDensities& densities, int pieces, InsideVolume& inside);

}  // namespace vicon::steps
