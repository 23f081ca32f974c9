#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>

#include "grid/allocate.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

/// Part of a grid: voxels from `low` on, before `high`; at first nothing.
struct VoxelBox {
    static constexpr int kFar = 1 << 27;  ///< beyond any grid; twice of it is still an integer
    Index3 low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};

    bool empty() const { return low.i >= high.i || low.j >= high.j || low.k >= high.k; }
    /// Makes it hold a voxel too.
    void take(Index3 v) { takeAll({v, {v.i + 1, v.j + 1, v.k + 1}}); }
    void takeAll(const VoxelBox& other)
    {
        low = {std::min(low.i, other.low.i), std::min(low.j, other.low.j), std::min(low.k, other.low.k)};
        high = {std::max(high.i, other.high.i), std::max(high.j, other.high.j), std::max(high.k, other.high.k)};
    }
    /// With a margin, as far as the grid goes.
    VoxelBox grown(int by, const Grid& grid) const
    {
        const auto [nx, ny, nz] = grid.size;
        return {{std::max(low.i - by, 0), std::max(low.j - by, 0), std::max(low.k - by, 0)},
                {std::min(high.i + by, nx), std::min(high.j + by, ny), std::min(high.k + by, nz)}};
    }
    friend bool operator==(const VoxelBox&, const VoxelBox&) = default;
};

/// Part of a grid as a grid of its own; it may reach beyond.
inline Grid cropped(const Grid& grid, const VoxelBox& box)
{
    Grid part = grid;
    part.size = {box.high.i - box.low.i, box.high.j - box.low.j, box.high.k - box.low.k};
    part.origin_mm = grid.pointAt(box.low);
    return part;
}

/// Part of a volume on a grid of its own. The box must lie inside.
template <class T>
Volume<T> cropped(const Volume<T>& volume, const VoxelBox& box)
{
    auto part = makeVolume<T>(cropped(volume.grid, box));
    const auto [columns, rows, slices] = part.grid.size;
    tbb::parallel_for(0, slices, [&, columns = columns, rows = rows](int k) {
        for (int j = 0; j < rows; ++j)
            std::copy_n(&volume.at({box.low.i, box.low.j + j, box.low.k + k}), columns, &part.at({0, j, k}));
    });
    return part;
}

}  // namespace vicon::steps
