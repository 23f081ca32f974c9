#pragma once

#include <vector>

#include "vicon/core/untrusted_wall.h"
#include "vicon/steps/tissue.h"

namespace vicon::steps {

/// Closes the holes of walls between parts of the lumen that lie apart by way of it. Where two loops touch, or a fold
/// is thin, blur leaves a wall less than half a voxel of tissue; what is left of it is a ridge of the fraction that
/// every way through the hole must cross. A hole without such a ridge is none that the fraction could tell from a
/// passage, and stays.
/// @param tissue raised above one half where a hole is closed
/// @param lumen there no lumen any more
/// @return in the order of their voxels
std::vector<FaintWall> closeFaintWalls(TissueVolume& tissue, InsideVolume& lumen);

}  // namespace vicon::steps
