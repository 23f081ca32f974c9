#pragma once

#include "vicon/core/volume.h"

namespace vicon::test {

/// How far a lumen lies from the true one.
struct LumenErrors {
    double dice = 0;                 ///< on the found lumen's grid, of the nearest voxels' labels
    double outside_ml = 0;           ///< found voxels whose nearest voxel of the truth is outside
    double far_outside_ml = 0;       ///< of these, centres farther than half a voxel's diagonal from any true voxel
    double missed_ml = 0;            ///< true voxels whose nearest found voxel is outside
    double far_missed_ml = 0;        ///< of these, as above
    double surface_95_mm = 0;        ///< 95th percentile of the distances between the two surfaces, both ways
    double found_surface_95_mm = 0;  ///< from the found surface to the true one only
    double true_surface_95_mm = 0;   ///< from the true surface to the found one only
};

/// Compares a lumen with the truth. The found surface is the one that is shown (extractCells); the true one lies
/// half-way through its voxels, filtered 1-2-1 along each axis, which takes the steps off a slanted wall.
LumenErrors lumenErrors(const HuVolume& volume, const InsideVolume& found, const InsideVolume& truth);

}  // namespace vicon::test
