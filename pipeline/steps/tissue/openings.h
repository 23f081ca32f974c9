#pragma once

#include <cstddef>
#include <vector>

#include "tissue/mixture.h"
#include "vicon/core/untrusted_wall.h"
#include "vicon/steps/tissue.h"

namespace vicon::steps {

/// Settles where the lumen goes on beyond its labels without a wall. A pocket that has walls of its own all around is
/// lumen too. Elsewhere other bowel with tagging lies behind a wall that is thinner than the densities show: such
/// openings are closed. What grew into them, and what hangs in them by less than three voxels, is no lumen.
/// @param mixture with the labels that the lumen was made from
/// @param other_bowel voxels that are no lumen, ascending
/// @param tissue raised above one half where an opening is closed
/// @return what was closed, in the order of its voxels
std::vector<FaintWall> settleOpenings(const Mixture& mixture, const std::vector<std::size_t>& other_bowel,
                                      TissueVolume& tissue, InsideVolume& lumen);

}  // namespace vicon::steps
