#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "vicon/core/geometry.h"
#include "vicon/viewer/model/sight_lines.h"

namespace vicon::viewer {

/// Which patches have triangles in which cube. A cube is the box between eight voxel centres; cube n along an axis lies
/// between voxels n - 1 and n. Kept by blocks of 4 x 4 x 4 cubes, a bit a cube.
class PatchBlocks {
public:
    PatchBlocks(const Grid& grid, const DrawnSurface& surface);

    /// Calls visit(patch) for every patch with a triangle in a cube from `low` to `high`; maybe more than once.
    template <class Visit>
    void forPatches(std::array<int, 3> low, std::array<int, 3> high, Visit visit) const
    {
        for (std::size_t d = 0; d < 3; ++d) {
            low[d] = std::max(low[d], 0);
            high[d] = std::min(high[d], 4 * size_[d] - 1);
        }
        for (int k = low[2] >> 2; k <= high[2] >> 2; ++k)
            for (int j = low[1] >> 2; j <= high[1] >> 2; ++j)
                for (int i = low[0] >> 2; i <= high[0] >> 2; ++i) {
                    const std::size_t block = offset({i, j, k});
                    if (first_[block] == first_[block + 1])
                        continue;
                    const std::uint64_t asked =
                        rowOf(low[0], high[0], i) * columnOf(low[1], high[1], j) * sliceOf(low[2], high[2], k);
                    for (std::uint32_t n = first_[block]; n < first_[block + 1]; ++n)
                        if (entries_[n].cubes & asked)
                            visit(entries_[n].patch);
                }
    }

private:
    struct Entry {
        std::uint64_t cubes;  ///< bit x + 4 y + 16 z
        std::uint32_t patch;
    };

    // Bits of the cubes of a block between low and high along each axis; the product of the three are those of a box.
    static std::uint64_t bits(int low, int high, int block)
    {
        const int from = std::max(low - 4 * block, 0), to = std::min(high - 4 * block, 3);
        return (std::uint64_t(2) << to) - (std::uint64_t(1) << from);
    }
    static std::uint64_t rowOf(int low, int high, int block) { return bits(low, high, block); }
    static std::uint64_t columnOf(int low, int high, int block)
    {
        const std::uint64_t b = bits(low, high, block);
        return (b & 1) | (b & 2) << 3 | (b & 4) << 6 | (b & 8) << 9;
    }
    static std::uint64_t sliceOf(int low, int high, int block)
    {
        const std::uint64_t b = bits(low, high, block);
        return (b & 1) | (b & 2) << 15 | (b & 4) << 30 | (b & 8) << 45;
    }

    std::size_t offset(const std::array<int, 3>& block) const
    {
        return std::size_t(block[0]) +
               std::size_t(size_[0]) * (std::size_t(block[1]) + std::size_t(size_[1]) * std::size_t(block[2]));
    }

    std::array<int, 3> size_{};         ///< in blocks
    std::vector<std::uint32_t> first_;  ///< of each block: where its entries begin
    std::vector<Entry> entries_;
};

}  // namespace vicon::viewer
