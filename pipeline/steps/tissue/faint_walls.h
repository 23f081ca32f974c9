#pragma once

#include <vector>

#include "tissue/closed_walls.h"
#include "tissue/levels.h"
#include "tissue/stool.h"
#include "vicon/steps/tissue.h"

namespace vicon::steps {

/// Closes the holes of thin walls and folds (findThinHoles), but not the only way between two parts.
/// @param labels of the segmentation, on the lumen's grid: an only way that it closed is closed
/// @param stool beside which gas and tagging in one voxel look like tissue: no holes are sought there
/// @param down no level of fluid under gas is a wall, however much tissue coarse voxels seem to hold there
/// @param tissue raised above one half where a hole is closed
/// @param lumen there no lumen any more
/// @return in the order of their voxels
std::vector<ClosedWall> closeFaintWalls(const InsideVolume& labels, const Stool& stool, const DownAxis& down,
                                        TissueVolume& tissue, InsideVolume& lumen);

}  // namespace vicon::steps
