#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "block_grid.h"
#include "vicon/core/geometry.h"
#include "vicon/viewer/model/sight_lines.h"

namespace vicon::viewer {

/// Which patches have triangles in which cube. A cube is the box between eight voxel centres; cube n along an axis lies
/// between voxels n - 1 and n.
class PatchBlocks {
public:
    PatchBlocks(const Grid& grid, const DrawnSurface& surface);

    /// Cubes put down, of those blocks that hold triangles. Threads may put down at the same time.
    using Cubes = std::vector<std::uint64_t>;
    Cubes none() const { return Cubes(first_.size() - 1, 0); }

    /// Puts down the cubes from `low` to `high`.
    void add(Cubes& cubes, const std::array<int, 3>& low, const std::array<int, 3>& high) const
    {
        blocks_.any(low, high, [&](std::size_t block, std::uint64_t box) {
            if (number_[block] != kEmpty) {
                const std::atomic_ref<std::uint64_t> of_block(cubes[number_[block]]);
                if (box & ~of_block.load(std::memory_order_relaxed))  // boxes overlap: most bring nothing new
                    of_block.fetch_or(box, std::memory_order_relaxed);
            }
            return false;
        });
    }

    /// For every patch 1 when it has a triangle in one of these cubes, else 0.
    std::vector<std::uint8_t> patchesIn(const Cubes& cubes) const;

private:
    struct Entry {
        std::uint64_t cubes;
        std::uint32_t patch;
    };
    static constexpr std::uint32_t kEmpty = 0xFFFFFFFF;

    BlockGrid blocks_;
    std::vector<std::uint32_t> number_;  ///< of each block among those that hold triangles
    std::vector<std::uint32_t> first_;   ///< of each of those: where its entries begin
    std::vector<Entry> entries_;
    std::size_t patches_ = 0;
};

}  // namespace vicon::viewer
