#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "vicon/core/volume_view.h"

namespace vicon::viewer {

/// How far around a place nothing but lumen lies, or nothing but what is outside of it; counted in voxels along the
/// axes of the grid.
///
/// It speaks of cubes, the boxes between eight voxel centres. The surface has been contoured within cubes of which some
/// corners are inside and some are not (wall); it never enters those with all corners inside (open) or none (solid).
class SightField {
public:
    explicit SightField(const InsideView& inside);

    enum class Kind { open, wall, solid };
    /// A place's kind, and the half edge, in voxels, of a box around it that holds no cube of another kind.
    struct Clear {
        Kind kind = Kind::solid;
        double voxels = 0;
    };

    /// @param p in voxels: index 0 is the centre of the first voxel
    Clear at(const std::array<double, 3>& p) const
    {
        std::array<int, 3> cube{};
        double to_side = 1, beyond = 0;
        for (std::size_t d = 0; d < 3; ++d) {
            const double low = std::floor(p[d]);
            cube[d] = int(low) + 1;
            to_side = std::min({to_side, p[d] - low, 1 - (p[d] - low)});
            beyond = std::max({beyond, -1 - p[d], p[d] - (size_[d] - 1)});
        }
        for (std::size_t d = 0; d < 3; ++d)
            if (cube[d] < 0 || cube[d] >= size_[d])
                return {Kind::solid, std::max(0.0, beyond)};
        const int steps =
            steps_[std::size_t(cube[0]) +
                   std::size_t(size_[0]) * (std::size_t(cube[1]) + std::size_t(size_[1]) * std::size_t(cube[2]))];
        if (steps == 0)
            return {Kind::wall, 0};
        return {steps > 0 ? Kind::open : Kind::solid, std::abs(steps) - 1 + to_side};
    }

    /// Whether all voxels of a rectangle of the plane across `axis` through voxels `plane` are outside: the surface
    /// does not cross such a plane between them. Ends belong to it; axes follow in the order 0, 1, 2, 0, 1.
    bool outside(std::size_t axis, int plane, std::array<int, 2> low, std::array<int, 2> high) const
    {
        std::array<int, 3> v{};
        v[axis] = plane;
        const std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
        for (v[a] = low[0]; v[a] <= high[0]; ++v[a])
            for (v[b] = low[1]; v[b] <= high[1]; ++v[b])
                if (grid_.contains({v[0], v[1], v[2]}) && inside_[grid_.offset({v[0], v[1], v[2]})])
                    return false;
        return true;
    }

    const Grid& grid() const { return grid_; }
    /// Cubes along each axis: one more than voxels, as the surface closes around voxels at the grid's border.
    const std::array<int, 3>& cubes() const { return size_; }

private:
    void classifyRow(const InsideView& inside, int j, int k, std::vector<std::uint8_t>& steps);

    Grid grid_;
    std::array<int, 3> size_{};
    std::vector<bool> inside_;        ///< of each voxel
    std::vector<std::int8_t> steps_;  ///< of each cube: steps to the next other one, negative in solid; 0 in the wall
};

}  // namespace vicon::viewer
