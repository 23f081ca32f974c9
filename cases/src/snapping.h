#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "vicon/core/skeleton.h"
#include "vicon/core/subdivision.h"
#include "vicon/core/volume.h"

namespace vicon {

/// Where a point of space lies in a scan's colon.
struct SnappedPoint {
    double outside_mm = 0;  ///< distance to the nearest inside voxel; 0 within the lumen
    double station_mm = 0;
    double length_mm = 0;  ///< of the skeleton
};

/// The places along a scan's skeleton; its files are read once for all of them.
class ScanPlaces {
public:
    /// Throws Error{not_ready} when the scan has not been through the pipeline.
    explicit ScanPlaces(const std::filesystem::path& scan_folder);

    /// A point's place along the skeleton, without jumping to a neighbouring loop: the nearest inside voxel's segment
    /// says which part of the curve is meant. Of a tree, along the way from the root that passes nearest to the point.
    /// Nothing when the point is farther than `within_mm` from the lumen.
    std::optional<SnappedPoint> at(Point3 point, double within_mm) const;

private:
    const Skeleton& wayNear(Point3 point) const;

    SegmentVolume segments_;
    Subdivision subdivision_;
    std::vector<Skeleton> ways_;  // one, or of a tree one to each tip
};

}  // namespace vicon
