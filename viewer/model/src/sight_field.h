#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "block_grid.h"
#include "float4.h"
#include "vicon/core/progress.h"
#include "vicon/core/volume_view.h"

namespace vicon::viewer {

/// How far around a place nothing but lumen lies, or nothing but what is outside of it; counted in voxels along the
/// axes of the grid.
///
/// It speaks of cubes, the boxes between eight voxel centres. The surface has been contoured within cubes of which some
/// corners are inside and some are not (wall); it never enters those with all corners inside (open) or none (solid).
class SightField {
public:
    /// Throws Error{cancelled} where `wanted` is no longer; nothing: it always is.
    SightField(const InsideView& inside, const Progress* wanted);

    enum class Kind { open, wall, solid };
    /// A place's kind, and the half edge, in voxels, of a box around it that holds no cube of another kind.
    struct Clear {
        Kind kind = Kind::solid;
        float voxels = 0;
    };

    /// @param p in voxels: index 0 is the centre of the first voxel
    Clear at(Float4 p) const
    {
        const Int4 low = floorOf(p);
        const std::array<int, 3> cube{low[0] + 1, low[1] + 1, low[2] + 1};
        for (std::size_t d = 0; d < 3; ++d)
            if (unsigned(cube[d]) >= unsigned(size_[d]))
                return {Kind::solid, std::max(0.0F, beyond(p))};
        const auto steps = int(steps_[cube_blocks_.elementOf(cube)]);
        if (steps == 0)
            return {Kind::wall, 0};
        const Float4 part = p - toFloat4(low), side = leastOf(part, 1 - part);
        const float to_side = std::min({side[0], side[1], side[2]});
        return {steps > 0 ? Kind::open : Kind::solid, float(std::abs(steps) - 1) + to_side};
    }

    /// Whether all voxels of a rectangle of the plane across `axis` through voxels `plane` are outside: the surface
    /// does not cross such a plane between them. Ends belong to it; axes follow in the order 0, 1, 2, 0, 1.
    bool outside(std::size_t axis, int plane, std::array<int, 2> low, std::array<int, 2> high) const
    {
        std::array<int, 3> from{}, to{};
        const std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
        from[axis] = to[axis] = plane;
        from[a] = low[0], to[a] = high[0];
        from[b] = low[1], to[b] = high[1];
        return !voxel_blocks_.any(from, to,
                                  [&](std::size_t block, std::uint64_t box) { return (inside_[block] & box) != 0; });
    }

    const Grid& grid() const { return grid_; }
    /// Cubes along each axis: one more than voxels, as the surface closes around voxels at the grid's border.
    const std::array<int, 3>& cubes() const { return size_; }

private:
    /// How far beyond the cubes a place lies.
    float beyond(Float4 p) const
    {
        float most = -1;
        for (int d = 0; d < 3; ++d)
            most = std::max({most, -1 - p[d], p[d] - float(size_[std::size_t(d)] - 1)});
        return most;
    }

    void classifyRow(const InsideView& inside, int j, int k, std::vector<std::uint8_t>& steps) const;
    void fillVoxelBlocks(const InsideView& inside);
    void fillCubeBlocks(const InsideView& inside, const std::vector<std::uint8_t>& steps);

    Grid grid_;
    std::array<int, 3> size_{};
    BlockGrid voxel_blocks_, cube_blocks_;
    std::vector<std::uint64_t> inside_;  ///< of each block of voxels: those in the lumen
    /// Of each cube, block by block, so that neighbours share lines of memory: steps to the next cube of another kind,
    /// negative in solid; 0 in the wall.
    std::vector<std::int8_t> steps_;
};

}  // namespace vicon::viewer
