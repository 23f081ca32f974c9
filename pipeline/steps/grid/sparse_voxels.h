#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "vicon/core/geometry.h"

namespace vicon::steps {

/// A set of few voxels of a grid, numbered in the order of their offsets. Those near a voxel are found row by row.
class SparseVoxels {
public:
    /// @param voxels offsets, ascending, each once
    SparseVoxels(const Grid& grid, std::vector<std::size_t> voxels)
        : grid_(grid),
          voxels_(std::move(voxels)),
          row_begin_(std::size_t(grid.size[1]) * std::size_t(grid.size[2]) + 1, 0)
    {
        const auto row = std::size_t(grid.size[0]);
        for (const std::size_t voxel : voxels_)
            ++row_begin_[voxel / row + 1];
        for (std::size_t n = 1; n < row_begin_.size(); ++n)
            row_begin_[n] += row_begin_[n - 1];
    }

    const Grid& grid() const { return grid_; }
    std::size_t size() const { return voxels_.size(); }
    std::size_t operator[](std::size_t n) const { return voxels_[n]; }
    /// The number of a voxel; size() where it is not in the set.
    std::size_t numberOf(std::size_t voxel) const
    {
        const std::size_t row = voxel / std::size_t(grid_.size[0]);
        const auto begin = voxels_.begin() + std::ptrdiff_t(row_begin_[row]);
        const auto end = voxels_.begin() + std::ptrdiff_t(row_begin_[row + 1]);
        const auto found = std::lower_bound(begin, end, voxel);
        return found != end && *found == voxel ? std::size_t(found - voxels_.begin()) : size();
    }
    /// Numbers of the first voxel of a slice, and of the one after its last.
    std::pair<std::size_t, std::size_t> inSlices(int from, int to) const
    {
        const auto begin = [&](int k) {
            return row_begin_[std::size_t(std::clamp(k, 0, grid_.size[2])) * std::size_t(grid_.size[1])];
        };
        return {begin(from), begin(to)};
    }

    /// Calls use(number) for those that lie at most `reach` steps along each axis from a voxel.
    template <class Use>
    void forNear(std::size_t voxel, int reach, Use use) const
    {
        const Index3 v = grid_.indexOf(voxel);
        const auto at = [this](std::size_t n) { return voxels_.begin() + std::ptrdiff_t(n); };
        for (int k = std::max(0, v.k - reach); k <= std::min(grid_.size[2] - 1, v.k + reach); ++k)
            for (int j = std::max(0, v.j - reach); j <= std::min(grid_.size[1] - 1, v.j + reach); ++j) {
                const std::size_t row = std::size_t(j) + std::size_t(grid_.size[1]) * std::size_t(k);
                const auto end = at(row_begin_[row + 1]);
                const std::size_t last = grid_.offset({std::min(grid_.size[0] - 1, v.i + reach), j, k});
                auto found = std::lower_bound(at(row_begin_[row]), end, grid_.offset({std::max(0, v.i - reach), j, k}));
                for (; found != end && *found <= last; ++found)
                    use(std::size_t(found - voxels_.begin()));
            }
    }

private:
    Grid grid_;
    std::vector<std::size_t> voxels_;
    std::vector<std::uint32_t> row_begin_;
};

}  // namespace vicon::steps
