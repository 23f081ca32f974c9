#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "subdivide/flood.h"
#include "vicon/steps/subdivide.h"

namespace vicon::steps {

/// A possible cut of the lumen: the inside voxels of a plane through a voxel of the path, as far as they are connected
/// to it within the plane. The voxels belong to the segment before the cut.
struct CutPlane {
    std::size_t at = 0;                 ///< index of the path's voxel
    Vector3 normal;                     ///< along the grid's axes, in voxels
    std::vector<std::uint32_t> voxels;  ///< sorted
    Index3 low, high;                   ///< their box
    double ratio = 1;                   ///< of the gate's sides
    double badness = 0;                 ///< 0 is ideal; what it measures is the criterion of effectiveness
    bool good = false;                  ///< meets the criterion of effectiveness
};

bool intersect(const CutPlane& a, const CutPlane& b);

/// Makes the portals of one path. Their mandatory criterion, that they cut the path exactly once, is tested here; that
/// they do not intersect each other is for the caller.
class CutPlanes {
public:
    CutPlanes(const InsideVolume& inside, const Skeleton& skeleton, const Path& path, const SubdivideOptions& options);

    /// The valid portals at a voxel of the path: up to three along the axes, or one across the regional tangent.
    std::vector<CutPlane> at(std::size_t n) const;

private:
    std::optional<CutPlane> cut(std::size_t n, Vector3 normal) const;
    bool cutsPathOnce(const CutPlane& plane) const;
    void rate(std::vector<CutPlane>& planes) const;
    Vector3 tangent(std::size_t n, std::size_t reach) const;
    double gateRatio(const CutPlane& plane) const;

    const InsideVolume& inside_;
    const Skeleton& skeleton_;
    const Path& path_;
    const SubdivideOptions& options_;
};

}  // namespace vicon::steps
