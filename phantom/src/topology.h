#pragma once

#include <array>
#include <vector>

#include "vicon/core/volume.h"

namespace vicon::phantom {

/// Euler number (pieces - tunnels + cavities) of the voxels that are not 0, where voxels that share a face, an edge or
/// a corner are connected.
int eulerNumber26(const InsideVolume& volume, Index3 low, std::array<int, 3> size);
/// The same where only voxels that share a face are connected.
int eulerNumber6(const InsideVolume& volume, Index3 low, std::array<int, 3> size);

/// Takes voxels out of the volume where they touch others by an edge or a corner alone, which is where the two Euler
/// numbers differ, as long as that takes neither further from the one wanted. Returns the voxels taken out.
std::vector<Index3> partAtCorners(InsideVolume& volume, Index3 low, std::array<int, 3> size, int wanted);
/// The other way: puts voxels in, as `kGas`, where that helps. Returns them.
std::vector<Index3> fillAtCorners(InsideVolume& volume, Index3 low, std::array<int, 3> size, int wanted);

/// Number of sets of voxels that are not 0 and hang together over faces.
int countPieces(InsideVolume volume);

}  // namespace vicon::phantom
