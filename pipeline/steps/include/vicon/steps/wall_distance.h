#pragma once

#include <cstddef>
#include <vector>

#include "vicon/core/progress.h"
#include "vicon/core/volume.h"
#include "vicon/steps/wall_densities.h"

namespace vicon::steps {

/// Distance from boundary: for every inside voxel the Euclidean distance in mm from its centre to the wall, which lies
/// half a voxel (half the smallest spacing) before the nearest outside voxel's centre; 0 outside. What lies beyond the
/// grid counts as outside. Exact: no nearer outside voxel exists. 1-Lipschitz between voxel centres.
/// Same grid as `inside`. The result does not depend on the number of threads.
FieldVolume wallDistance(const InsideVolume& inside, Progress& progress);

/// How far a voxel beside the wall, inside or outside, is from it.
struct NearWall {
    std::size_t offset;  ///< of the voxel in its grid
    float voxels;        ///< in voxels of the smallest spacing
};

/// The same with the wall where the densities cross the half level, to a fraction of a voxel (LumenSurface::nearWall):
/// before each outside voxel beside the lumen it lies as far as `wall` tells, and the nearest wall decides; beside the
/// wall a voxel's own distance is taken, at least 0.05 of a voxel.
/// @param wall all voxels beside the wall, inside and outside, each once
FieldVolume wallDistance(const InsideVolume& inside, const std::vector<NearWall>& wall, Progress& progress);

/// The same from the densities, with the wall where extractCells() has it. `hu` must lie on the lattice of `inside` and
/// may be larger. Throws Error{bad_input} when the lattices do not fit together.
FieldVolume wallDistance(const InsideVolume& inside, const HuVolume& hu, Progress& progress,
                         const WallDensities& densities = {});

}  // namespace vicon::steps
