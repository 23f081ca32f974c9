#pragma once

#include <cstdint>
#include <vector>

#include "course.h"
#include "vicon/core/progress.h"
#include "wall.h"

namespace vicon::phantom {

/// Signed distances to the colon on the voxels of a grid, within a band around it.
struct LumenField {
    static constexpr double kUnit_mm = 1.0 / 16;  ///< of the stored distances
    static constexpr std::int8_t kFar = 127;      ///< beyond the band
    static constexpr std::uint8_t kNoPool = 0xff;

    bool cropped = false;  ///< the colon does not lie within the grid as a whole
    Index3 low;            ///< first voxel of the box that holds the colon
    std::array<int, 3> size{0, 0, 0};
    std::vector<std::int8_t> lumen;    ///< distance to the lumen's surface, below 0 inside
    std::vector<std::int8_t> outside;  ///< distance to the outside of the wall, below 0 inside
    std::vector<std::uint8_t> pool;    ///< number of the pool whose stations a voxel lies at

    bool contains(Index3 v) const
    {
        return v.i >= low.i && v.j >= low.j && v.k >= low.k && v.i < low.i + size[0] && v.j < low.j + size[1] &&
               v.k < low.k + size[2];
    }
    std::size_t offset(Index3 v) const
    {
        return std::size_t(v.i - low.i) +
               std::size_t(size[0]) * (std::size_t(v.j - low.j) + std::size_t(size[1]) * std::size_t(v.k - low.k));
    }
};

/// Evaluates the implicit field |x - c(s)| - r(s, angle), the smallest over the whole curve, divided by its slope, so
/// that it is a distance to first order. Each voxel is visited once for every stretch of 1 mm between two normal planes
/// of the curve that it lies in.
LumenField rasterise(const Grid& grid, const Course& course, const Wall& wall, const std::vector<FluidPool>& pools,
                     Progress& progress);

/// Rounds what is finer than the voxels can show, so that the lumen's voxels have the topology of the lumen: the
/// distances are filtered with 1-2-1 along each axis, which leaves flat walls where they are. Polyps are left as they
/// are.
void roundOff(LumenField& field, const Grid& grid, const std::vector<Polyp>& polyps);

}  // namespace vicon::phantom
