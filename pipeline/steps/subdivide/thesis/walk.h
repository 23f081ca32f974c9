#pragma once

#include <functional>
#include <vector>

#include "subdivide/thesis/portal.h"

namespace vicon::steps {

/// Sizes along a path: what lies nearest to the path's voxels up to and including the n-th.
struct PathSizes {
    std::vector<double> up_to;
    double target = 0;  ///< of a segment

    double between(std::size_t after, std::size_t at) const { return up_to[at] - up_to[after]; }
};

/// The valid portals at a voxel of the path, as CutPlanes::at() gives them.
using PlanesAt = std::function<std::vector<CutPlane>(std::size_t n)>;

/// Algorithm 3.1: walks along the path, accepts the first portal that ends a segment of feasible size and is good;
/// when the segment grows too large goes back to the best one passed, and when there is none takes the next.
std::vector<CutPlane> walkLocally(const PlanesAt& planes, const PathSizes& sizes, Progress& progress);

}  // namespace vicon::steps
