#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "vicon/core/volume_view.h"

namespace vicon::viewer {

/// The least and the greatest density of bricks of 8 x 8 x 8 voxels, so that rays leap over what their colours do not
/// show. A brick is looked at when a ray first comes to it. To be asked by several threads at once.
class DensityBricks {
public:
    static constexpr int kEdgeBits = 3, kEdge = 1 << kEdgeBits;

    /// The voxels must outlive it.
    explicit DensityBricks(const HuView& volume);

    const HuView& volume() const { return volume_; }

    /// Of all voxels from which a sample or a gradient in the brick is made: those of the brick, one before it and two
    /// behind it.
    struct Range {
        std::int16_t lowest = 0, highest = 0;
        bool padding = true;  ///< some are padding, or lie beyond the scan
    };
    /// @param i, j, k of a voxel of the scan
    std::size_t brickOf(int i, int j, int k) const
    {
        return std::size_t(i >> kEdgeBits) + row_ * std::size_t(j >> kEdgeBits) + slice_ * std::size_t(k >> kEdgeBits);
    }
    Range around(std::size_t n) const
    {
        const std::uint64_t known = ranges_[n].load(std::memory_order_relaxed);
        return known == 0 ? look(n) : unpacked(known);
    }

private:
    static constexpr std::uint64_t kLooked = 1ULL << 33U, kPads = 1ULL << 32U;
    static Range unpacked(std::uint64_t known)
    {
        return {std::int16_t(known & 0xFFFFU), std::int16_t(known >> 16U & 0xFFFFU), (known & kPads) != 0};
    }
    Range look(std::size_t n) const;

    HuView volume_;
    std::size_t row_, slice_;
    std::unique_ptr<std::atomic<std::uint64_t>[]> ranges_;
};

}  // namespace vicon::viewer
