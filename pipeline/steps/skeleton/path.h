#pragma once

#include <functional>
#include <vector>

#include "grid/lumen_graph.h"
#include "vicon/core/progress.h"
#include "vicon/core/volume.h"
#include "vicon/steps/skeleton.h"

namespace vicon::steps {

/// The way through one piece of the lumen.
struct LumenPath {
    std::vector<Index3> voxels;     ///< 26-connected, all inside, from the rectal end to the caecal end
    double uncovered_fraction = 0;  ///< share of the piece that lies far from the path
    int cuts = 0;                   ///< contacts between loops that were cut to find the way
};

/// Finds the way between two points of the lumen. `coarse` is a graph of the whole lumen; where it does not connect the
/// two ends (a very narrow lumen) a graph of every voxel is made.
/// @param first is handed the voxels of the first path, on any thread; mostly the last, but what it leaves aside is
/// still to be looked at, which takes as long
/// Throws Error{bad_input} when the ends lie in
/// different components.
LumenPath findPath(const FieldVolume& wall_mm, const LumenGraph& coarse, Point3 from, Point3 to,
                   const SkeletonOptions& options, Progress& progress,
                   const std::function<void(const std::vector<Index3>&)>& first);

}  // namespace vicon::steps
