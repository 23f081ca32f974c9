#pragma once

#include <cstddef>
#include <vector>

#include "tissue/closed_walls.h"
#include "tissue/mixture.h"
#include "vicon/steps/tissue.h"

namespace vicon::steps {

/// What is known of where the lumen may go on.
struct BeyondLabels {
    const Mixture& mixture;                       ///< with the labels that the lumen was made from
    const RunLabels& pieces;                      ///< of those labels, over faces
    const std::vector<std::size_t>& other_bowel;  ///< voxels that are no lumen, ascending
    const std::vector<Point3>& cuts_mm;           ///< where a person cut the labels
};

/// Settles where the lumen goes on beyond its labels without a wall. A pocket that has walls of its own all around is
/// lumen too, unless it would join two pieces, or a person cut it off. Elsewhere other bowel with tagging lies behind a
/// wall that is thinner than the densities show: such openings are closed. What grew into them, and what hangs in them
/// by less than three voxels, is no lumen.
/// @param tissue raised above one half where an opening is closed
/// @return what was closed, in the order of its voxels; where a person cut, of no area
std::vector<ClosedWall> settleOpenings(const BeyondLabels& known, TissueVolume& tissue, InsideVolume& lumen);

}  // namespace vicon::steps
