#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vicon/core/geometry.h"
#include "vicon/core/progress.h"

namespace vicon::viewer {

/// How far two points of the wall lie apart.
struct WallDistance {
    double straight_mm = 0;      ///< between the points, through whatever lies between them
    double along_mm = 0;         ///< of the shortest way over the surface
    std::vector<Point3> way_mm;  ///< that way, both points included
};

/// Measures between the points of an indexed surface (three coordinates a point, three point numbers a triangle) that
/// lie nearest to `from` and `to`. The way runs straight within each triangle and crosses edges at one of their ends or
/// at one of six places between; what it is too long by is below 1 % on surfaces of known geodesics. Nothing where
/// the surface does not join the points within 400 mm. Points far apart take minutes; throws Error{cancelled} where
/// `wanted` is no longer.
std::optional<WallDistance> distanceOverWall(const std::vector<float>& points_mm,
                                             const std::vector<std::uint32_t>& triangles, Point3 from, Point3 to,
                                             const Progress* wanted = nullptr);

}  // namespace vicon::viewer
