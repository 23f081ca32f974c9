#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>

#include "vicon/core/geometry.h"

namespace vicon {

/// Any distance, for nearestVoxel().
inline constexpr double kAnyDistance_mm = std::numeric_limits<double>::infinity();

struct NearestVoxel {
    Index3 voxel;
    double distance_mm = 0;  ///< from the voxel's centre
};

/// Calls visit(Index3) for the voxels of a grid that are exactly `steps` steps away from a voxel along one axis and at
/// most that along the others.
template <class Visit>
void forEachInShell(const Grid& grid, Index3 middle, int steps, Visit visit)
{
    const auto within = [&](int centre, std::size_t axis) {
        return std::pair(std::max(centre - steps, 0), std::min(centre + steps, grid.size[axis] - 1));
    };
    const auto [first_i, last_i] = within(middle.i, 0);
    const auto [first_j, last_j] = within(middle.j, 1);
    const auto [first_k, last_k] = within(middle.k, 2);
    for (int k = first_k; k <= last_k; ++k)
        for (int j = first_j; j <= last_j; ++j) {
            const bool whole_row = std::abs(k - middle.k) == steps || std::abs(j - middle.j) == steps;
            for (int i = first_i; i <= last_i;) {
                if (whole_row || std::abs(i - middle.i) == steps)
                    visit(Index3{i++, j, k});
                else
                    i = middle.i + steps;  // the row's far side: between lie smaller shells
            }
        }
}

/// The voxel whose centre is nearest to a point, of those that wanted(Index3) accepts and that lie at most `within_mm`
/// away. Of two that are equally near it is the later one in memory. The point may lie beyond the grid.
template <class Wanted>
std::optional<NearestVoxel> nearestVoxel(const Grid& grid, Point3 point, double within_mm, Wanted wanted)
{
    const Index3 middle = grid.indexAt(point);
    const double smallest_mm = *std::min_element(grid.spacing_mm.begin(), grid.spacing_mm.end());
    const std::array<int, 3> at{middle.i, middle.j, middle.k};
    int farthest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        farthest = std::max({farthest, at[axis] + 1, grid.size[axis] - at[axis]});
    std::optional<NearestVoxel> best;
    double least_mm = within_mm;
    for (int steps = 0; steps <= farthest && (steps - 1) * smallest_mm <= least_mm; ++steps)
        forEachInShell(grid, middle, steps, [&](Index3 v) {
            if (!wanted(v))
                return;
            const double distance_mm = distance(grid.pointAt(v), point);
            const bool later = !best || grid.offset(best->voxel) < grid.offset(v);
            if (distance_mm < least_mm || (distance_mm == least_mm && later)) {
                least_mm = distance_mm;
                best = NearestVoxel{v, distance_mm};
            }
        });
    return best;
}

}  // namespace vicon
