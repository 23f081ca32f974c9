#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "vicon/core/geometry.h"

namespace vicon::steps {

/// From a voxel to its neighbours over faces: -x, +x, -y, +y, -z, +z.
inline constexpr std::array<Index3, 6> kFaces{{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

/// The lines through a voxel and its neighbours.
inline constexpr std::array<Index3, 13> kLines{{{1, 0, 0},
                                                {0, 1, 0},
                                                {0, 0, 1},
                                                {1, 1, 0},
                                                {1, -1, 0},
                                                {1, 0, 1},
                                                {1, 0, -1},
                                                {0, 1, 1},
                                                {0, 1, -1},
                                                {1, 1, 1},
                                                {1, 1, -1},
                                                {1, -1, 1},
                                                {-1, 1, 1}}};

constexpr Index3 shifted(Index3 v, Index3 by)
{
    return {v.i + by.i, v.j + by.j, v.k + by.k};
}

/// So many steps from a voxel along a line, backwards where below 0.
constexpr Index3 along(Index3 v, Index3 line, int steps)
{
    return {v.i + steps * line.i, v.j + steps * line.j, v.k + steps * line.k};
}

/// How far apart voxels lie along a line.
inline double stepLength_mm(const Grid& grid, Index3 line)
{
    return std::hypot(line.i * grid.spacing_mm[0], line.j * grid.spacing_mm[1], line.k * grid.spacing_mm[2]);
}

/// Calls use(offset) for the voxels of the grid that share a face with a voxel, in the order of kFaces.
template <class Use>
void forEachOverFaces(const Grid& grid, std::size_t voxel, Use use)
{
    const Index3 v = grid.indexOf(voxel);
    const std::array<int, 3> at{v.i, v.j, v.k};
    std::size_t stride = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (at[axis] > 0)
            use(voxel - stride);
        if (at[axis] + 1 < grid.size[axis])
            use(voxel + stride);
        stride *= std::size_t(grid.size[axis]);
    }
}

/// Calls use(Index3) for all within `reach` steps along each axis, the voxel itself among them, in the order of memory;
/// they may lie beyond the grid.
template <class Use>
void forEachInCube(Index3 v, int reach, Use use)
{
    for (int k = v.k - reach; k <= v.k + reach; ++k)
        for (int j = v.j - reach; j <= v.j + reach; ++j)
            for (int i = v.i - reach; i <= v.i + reach; ++i)
                use(Index3{i, j, k});
}

/// Whether wanted(Index3) holds for any of them.
template <class Wanted>
bool anyInCube(Index3 v, int reach, Wanted wanted)
{
    for (int k = v.k - reach; k <= v.k + reach; ++k)
        for (int j = v.j - reach; j <= v.j + reach; ++j)
            for (int i = v.i - reach; i <= v.i + reach; ++i)
                if (wanted(Index3{i, j, k}))
                    return true;
    return false;
}

/// Floods over faces from the voxels of `front`: take(offset) marks a voxel and says whether the flood goes on from it;
/// it is asked again for voxels that it refused or took before.
template <class Take>
void floodOverFaces(const Grid& grid, std::vector<std::size_t> front, Take take)
{
    while (!front.empty()) {
        const std::size_t voxel = front.back();
        front.pop_back();
        forEachOverFaces(grid, voxel, [&](std::size_t beside) {
            if (take(beside))
                front.push_back(beside);
        });
    }
}

}  // namespace vicon::steps
