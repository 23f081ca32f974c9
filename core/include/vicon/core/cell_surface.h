#pragma once

#include <cstdint>
#include <vector>

#include "vicon/core/geometry.h"

namespace vicon {

/// The surface of the colon as indexed triangles; each cell is one contiguous range of triangles.
struct CellSurface {
    std::vector<float> points_mm;          ///< x, y, z of each point, LPS
    std::vector<float> normals;            ///< unit vectors into the lumen, as many as points
    std::vector<std::uint32_t> triangles;  ///< three point numbers each; front side seen from inside the lumen
    std::vector<std::uint16_t> segment;    ///< of each triangle; never decreasing

    std::size_t pointCount() const { return points_mm.size() / 3; }
    std::size_t triangleCount() const { return triangles.size() / 3; }
    Point3 point(std::size_t n) const { return {points_mm[3 * n], points_mm[3 * n + 1], points_mm[3 * n + 2]}; }
};

}  // namespace vicon
