#pragma once

#include "grid/wall_field.h"

namespace vicon::steps {

/// Voxels of fluid that belong to folds so thin that the scanner's blur lifts them above half-way between tissue and
/// fluid: left in the lumen they tear the fold. Such a voxel lies in a valley of the densities, with brighter fluid on
/// both sides, nearer to the valley's bottom than to the fluid; and it hangs together with the wall, which noise in the
/// pool does not. Thick folds and polyps have tissue in them, whose half-way is where it always was.
/// Takes away only, and nothing that would part a piece.
/// @param inside the chosen pieces, gas and fluid; on the lattice of `volume`
/// @param pieces how many connected parts `inside` has
void keepThinFolds(const HuVolume& volume, const WallDensities& densities, int pieces, InsideVolume& inside);

}  // namespace vicon::steps
