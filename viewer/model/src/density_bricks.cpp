#include "vicon/viewer/model/density_bricks.h"

#include <algorithm>
#include <array>

namespace vicon::viewer {
namespace {

std::size_t bricksAlong(const Grid& grid, std::size_t axis)
{
    return std::size_t((grid.size[axis] + DensityBricks::kEdge - 1) >> DensityBricks::kEdgeBits);
}

}  // namespace

DensityBricks::DensityBricks(const HuView& volume)
    : volume_(volume),
      row_(bricksAlong(volume.grid, 0)),
      slice_(row_ * bricksAlong(volume.grid, 1)),
      ranges_(std::make_unique<std::atomic<std::uint64_t>[]>(slice_ * bricksAlong(volume.grid, 2)))
{
}

DensityBricks::Range DensityBricks::look(std::size_t n) const
{
    const Grid& grid = volume_.grid;
    const std::array<std::size_t, 3> brick{n % row_, n % slice_ / row_, n / slice_};
    std::array<int, 3> from{}, to{};
    Range range{INT16_MAX, INT16_MIN, false};
    for (std::size_t d = 0; d < 3; ++d) {
        const int first = int(brick[d]) * kEdge - 1, last = first + kEdge + 2;
        from[d] = std::max(first, 0);
        to[d] = std::min(last, grid.size[d] - 1);
        range.padding |= from[d] != first || to[d] != last;
    }
    for (int k = from[2]; k <= to[2]; ++k)
        for (int j = from[1]; j <= to[1]; ++j) {
            const std::int16_t* row = &volume_.at({0, j, k});
            const auto [lowest, highest] = std::minmax_element(row + from[0], row + to[0] + 1);
            range.lowest = std::min(range.lowest, *lowest);
            range.highest = std::max(range.highest, *highest);
        }
    range.padding |= range.lowest <= kPaddingHu;  // nothing is measured below it
    ranges_[n].store(kLooked | (range.padding ? kPads : 0) | std::uint64_t(std::uint16_t(range.highest)) << 16U |
                         std::uint16_t(range.lowest),
                     std::memory_order_relaxed);
    return range;
}

}  // namespace vicon::viewer
