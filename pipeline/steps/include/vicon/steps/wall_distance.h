#pragma once

#include "vicon/core/progress.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

/// Distance from boundary: for every inside voxel the Euclidean distance in mm from its centre to the wall, which lies
/// half a voxel (half the smallest spacing) before the nearest outside voxel's centre; 0 outside. What lies beyond the
/// grid counts as outside. Exact: no nearer outside voxel exists. 1-Lipschitz between voxel centres.
/// Same grid as `inside`. The result does not depend on the number of threads.
FieldVolume wallDistance(const InsideVolume& inside, Progress& progress);

/// The same with the wall where the densities cross the half level, to a fraction of a voxel: beside gas at -480 HU,
/// under fluid half-way between tissue (40 HU) and the local fluid. Every voxel's distance is corrected by where the
/// wall lies before its nearest outside voxel; within one voxel of the wall at least 0.05 of a voxel. `hu` must lie on
/// the lattice of `inside` and may be larger. Throws Error{bad_input} when the lattices do not fit together.
FieldVolume wallDistance(const InsideVolume& inside, const HuVolume& hu, Progress& progress);

}  // namespace vicon::steps
