#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace vicon::viewer {

/// A grid's elements (voxels, or the cubes between them) by blocks of 4 x 4 x 4: those of a block are bits of one word,
/// bit x + 4 y + 16 z, so that a box is put down or asked for with a few words.
class BlockGrid {
public:
    static constexpr std::size_t kPlaces = 64;  ///< of a block

    BlockGrid() = default;
    explicit BlockGrid(const std::array<int, 3>& elements)
    {
        for (std::size_t d = 0; d < 3; ++d)
            size_[d] = (elements[d] + 3) >> 2;
    }

    std::size_t count() const { return std::size_t(size_[0]) * std::size_t(size_[1]) * std::size_t(size_[2]); }
    /// The number of the block that holds an element of the grid.
    std::size_t blockOf(const std::array<int, 3>& at) const { return number(at[0] >> 2, at[1] >> 2, at[2] >> 2); }
    /// The number of an element where blocks follow each other.
    std::size_t elementOf(const std::array<int, 3>& at) const
    {
        return blockOf(at) * kPlaces + std::size_t(placeOf(at));
    }
    /// The place of an element in its block.
    static int placeOf(const std::array<int, 3>& at) { return (at[0] & 3) + 4 * (at[1] & 3) + 16 * (at[2] & 3); }

    /// Calls test(block, bits) for the blocks of a box, ends included, until one says true; what lies outside of the
    /// blocks does not count. Returns whether one did.
    template <class Test>
    bool any(std::array<int, 3> low, std::array<int, 3> high, Test test) const
    {
        for (std::size_t d = 0; d < 3; ++d) {
            low[d] = std::max(low[d], 0);
            high[d] = std::min(high[d], 4 * size_[d] - 1);
        }
        for (int k = low[2] >> 2; k <= high[2] >> 2; ++k) {
            const std::uint64_t slices = kBits[2][between(low[2], high[2], k)];
            for (int j = low[1] >> 2; j <= high[1] >> 2; ++j) {
                const std::uint64_t columns = slices & kBits[1][between(low[1], high[1], j)];
                for (int i = low[0] >> 2; i <= high[0] >> 2; ++i)
                    if (test(number(i, j, k), columns & kBits[0][between(low[0], high[0], i)]))
                        return true;
            }
        }
        return false;
    }

private:
    std::size_t number(int i, int j, int k) const
    {
        return std::size_t(i) + std::size_t(size_[0]) * (std::size_t(j) + std::size_t(size_[1]) * std::size_t(k));
    }

    // Of a block's four places along one axis the first and the last between low and high, as a number of kBits.
    static std::size_t between(int low, int high, int block)
    {
        const int from = std::max(low - 4 * block, 0), to = std::min(high - 4 * block, 3);
        return 4 * std::size_t(from) + std::size_t(to);
    }
    // For each axis the bits of all elements from one place along it to another.
    static constexpr std::array<std::array<std::uint64_t, 16>, 3> kBits = [] {
        std::array<std::array<std::uint64_t, 16>, 3> bits{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t from = 0; from < 4; ++from)
                for (std::size_t to = from; to < 4; ++to)
                    for (std::size_t place = 0; place < kPlaces; ++place)
                        if (const std::size_t at = place >> (2 * axis) & 3; at >= from && at <= to)
                            bits[axis][4 * from + to] |= std::uint64_t(1) << place;
        return bits;
    }();

    std::array<int, 3> size_{};  ///< in blocks
};

}  // namespace vicon::viewer
