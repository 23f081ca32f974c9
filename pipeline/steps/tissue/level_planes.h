#pragma once

#include "tissue/level_voxels.h"

namespace vicon::steps {

/// Each column's plane as it is in the middle of the lumen: that of the columns around which are lumen where they pass
/// tissue's density. Beside a wall the density passes it up to a voxel off, where the wall leaves room for a wedge of
/// gas or fluid alone, or where fluid rises along it. Columns with none around take the plane of those next to them.
/// @param tissue as applyLevels() left it
/// @return depths, see DownAxis
std::vector<float> settledPlanes(const Mixture& mixture, const DownAxis& down, const FluidLevels& levels,
                                 const LevelVoxels& voxels, const TissueVolume& tissue);

}  // namespace vicon::steps
