#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "subdivide/segments.h"
#include "vicon/core/skeleton.h"
#include "vicon/steps/subdivide.h"

namespace vicon::steps {

/// A voxel of the skeleton's path.
struct PathVoxel {
    std::size_t voxel = 0;
    double station_mm = 0;  ///< never decreasing along a path
};

/// The path through one connected piece of the skeleton.
struct Path {
    int piece = 0;  ///< number of the skeleton's piece
    std::vector<PathVoxel> voxels;
};

/// The paths as voxels of `inside`, with their stations on the curve. Points of a path that lie outside are left out.
std::vector<Path> pathsOf(const InsideVolume& inside, const Skeleton& skeleton, const SkeletonVoxels& voxels);

struct Labelling {
    std::vector<std::uint16_t> label;  ///< of every voxel, 1..pieces.size(), 0 outside
    std::vector<LabelledPiece> pieces;
};

/// Cuts each path into pieces of about `length_mm` and floods all of them at once inside the lumen: each voxel takes
/// the label of the front that reaches it first. Parts of the lumen that no path reaches get labels of their own.
/// @param ahead what floodFrom() made of paths found earlier; made anew when it is of other paths
Labelling floodPieces(const InsideVolume& inside, const Skeleton& skeleton, const std::vector<Path>& paths,
                      double length_mm, std::optional<PathFlood> ahead);

}  // namespace vicon::steps
