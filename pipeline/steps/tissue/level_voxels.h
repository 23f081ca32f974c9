#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "tissue/levels.h"

namespace vicon::steps {

/// The voxels of the levels' layers, by their place.
class LevelVoxels {
public:
    LevelVoxels(const std::vector<LevelVoxel>& voxels, const Grid& grid, const DownAxis& down)
        : voxels_(voxels), down_(down), a_((down.axis + 1) % 3), b_((down.axis + 2) % 3), size_(grid.size)
    {
        std::sort(voxels_.begin(), voxels_.end(), [&](const LevelVoxel& x, const LevelVoxel& y) {
            return std::pair(cellOf(x.at), down_.along(x.at)) < std::pair(cellOf(y.at), down_.along(y.at));
        });
        begin_.assign(std::size_t(size_[std::size_t(a_)]) * std::size_t(size_[std::size_t(b_)]) + 1, 0);
        for (const LevelVoxel& voxel : voxels_)
            ++begin_[cellOf(voxel.at) + 1];
        for (std::size_t n = 1; n < begin_.size(); ++n)
            begin_[n] += begin_[n - 1];
    }

    std::size_t size() const { return voxels_.size(); }
    const LevelVoxel& operator[](std::size_t n) const { return voxels_[n]; }

    /// Its number; nothing where the voxel is in no layer. The voxel is one of the grid's.
    std::optional<std::size_t> find(Index3 v) const
    {
        const std::size_t cell = cellOf(v);
        const int along = down_.along(v);
        for (std::size_t n = begin_[cell]; n < begin_[cell + 1]; ++n)
            if (down_.along(voxels_[n].at) == along)
                return n;
        return std::nullopt;
    }

    /// Calls use(voxel) for those of the grid's column at a voxel, from above or from below.
    template <class Use>
    void forColumn(Index3 v, Use use) const
    {
        const std::size_t cell = cellOf(v);
        for (std::size_t n = begin_[cell]; n < begin_[cell + 1]; ++n)
            use(voxels_[n]);
    }

private:
    std::size_t cellOf(Index3 v) const
    {
        return std::size_t(coordinate(v, a_)) + std::size_t(size_[std::size_t(a_)]) * std::size_t(coordinate(v, b_));
    }

    std::vector<LevelVoxel> voxels_;
    const DownAxis& down_;
    int a_, b_;
    std::array<int, 3> size_;
    std::vector<std::uint32_t> begin_;  ///< first voxel of each column of the grid
};

}  // namespace vicon::steps
