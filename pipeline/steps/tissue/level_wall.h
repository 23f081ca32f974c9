#pragma once

#include "tissue/level_voxels.h"

namespace vicon::steps {

/// Betters the fraction of tissue where a level meets the wall. The blurred plane's shares of gas and fluid are wrong
/// there, where the wall leaves room for one of them: here they are those of the lumen found so far, blurred. Where
/// that mixture has tissue's density and a voxel tells nothing, the next ones that do along the wall tell, and not
/// those above and below: the wall goes on straight, whatever its angle. How high fluid stands beside walls is fitted
/// to the scan. In rounds, as each knows the others better.
/// @param voxels of applyLevels()
void refineAtWall(const Mixture& mixture, const DownAxis& down, const FluidLevels& levels, const LevelVoxels& voxels,
                  double noise_hu, TissueVolume& tissue);

}  // namespace vicon::steps
