#pragma once

#include <vector>

#include "vicon/core/geometry.h"

namespace vicon {

/// A point of the smooth centred curve.
struct SkeletonPoint {
    Point3 position_mm;
    double station_mm = 0;  ///< arc length from the rectal end; never decreasing
    double radius_mm = 0;   ///< distance to the wall
};

/// One connected piece of the curve, or a bridge over a collapsed part between two pieces.
struct SkeletonPiece {
    bool bridge = false;
    std::vector<SkeletonPoint> points;  ///< at least two, from the rectal side
};

/// Where a point of space projects to on the curve.
struct SkeletonFoot {
    double station_mm = 0;
    double distance_mm = 0;
    Point3 position_mm;
    bool on_bridge = false;
};

/// The smooth curve from rectum to caecum, pieces and bridges in order.
struct Skeleton {
    std::vector<SkeletonPiece> pieces;

    bool empty() const { return pieces.empty(); }
    double length_mm() const { return empty() ? 0 : pieces.back().points.back().station_mm; }
    /// The point at a station, interpolated; stations outside are clamped to the ends.
    SkeletonPoint at(double station_mm) const;
    /// Unit tangent towards the caecum, over `window_mm` of the curve around the station.
    Vector3 tangentAt(double station_mm, double window_mm = 4) const;
    bool onBridge(double station_mm) const;
    /// The nearest point of the curve among stations in [from_mm, to_mm].
    SkeletonFoot nearest(Point3 p, double from_mm = 0, double to_mm = 1e9) const;
};

/// The thesis' 26-connected path: voxel centres in order from the rectum, one list per connected piece.
using SkeletonVoxels = std::vector<std::vector<Point3>>;

}  // namespace vicon
