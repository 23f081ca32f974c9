#pragma once

#include <vector>

#include "tissue/stool.h"
#include "vicon/core/untrusted_wall.h"
#include "vicon/steps/tissue.h"

namespace vicon::steps {

/// Closes the holes of thin walls and folds: where both sides of a hole hang together by the open lumen, but not near
/// it. Blur leaves a wall less than half a voxel of tissue there; what is left of it is a ridge of the fraction that
/// every way through the hole must cross. A hole without such a ridge is none that the fraction could tell from a
/// passage, and stays; so does the only way between two parts.
/// @param stool beside which gas and tagging in one voxel look like tissue: no holes are sought there
/// @param tissue raised above one half where a hole is closed
/// @param lumen there no lumen any more
/// @return in the order of their voxels
std::vector<FaintWall> closeFaintWalls(const Stool& stool, TissueVolume& tissue, InsideVolume& lumen);

}  // namespace vicon::steps
