#include "grid/brick_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "vicon/core/error.h"

namespace vicon::steps {

constexpr std::array<std::array<BrickGrid::Step, 6>, BrickGrid::kVoxels> BrickGrid::steps()
{
    constexpr std::uint8_t kOwn = 6;  // the brick itself, after its six sides
    std::array<std::array<Step, 6>, kVoxels> all{};
    for (std::uint32_t n = 0; n < kVoxels; ++n) {
        std::uint32_t stride = 1;
        for (std::size_t d = 0; d < 3; ++d, stride *= kEdge) {
            const std::uint32_t at = n / stride % kEdge, far = (kEdge - 1) * stride;
            all[n][2 * d] =
                at > 0 ? Step{kOwn, std::uint8_t(n - stride)} : Step{std::uint8_t(2 * d), std::uint8_t(n + far)};
            all[n][2 * d + 1] = at + 1 < kEdge ? Step{kOwn, std::uint8_t(n + stride)}
                                               : Step{std::uint8_t(2 * d + 1), std::uint8_t(n - far)};
        }
    }
    return all;
}

// Geometry of a brick.
constexpr std::array<std::array<BrickGrid::Step, 6>, BrickGrid::kVoxels> BrickGrid::kSteps = BrickGrid::steps();

BrickGrid::BrickGrid(const InsideVolume& inside) : grid_(inside.grid)
{
    number(inside);
    join();
}

/// Finds the bricks with something inside, and numbers them in order.
void BrickGrid::number(const InsideVolume& inside)
{
    for (std::size_t d = 0; d < 3; ++d)
        size_[d] = (std::uint32_t(grid_.size[d]) + kEdge - 1) / kEdge;
    brick_of_.assign(std::size_t(size_[0]) * size_[1] * size_[2], 0);
    tbb::parallel_for(std::uint32_t(0), size_[2], [&](std::uint32_t bk) {
        const int end = std::min(grid_.size[2], int((bk + 1) * kEdge));
        for (int k = int(bk * kEdge); k < end; ++k)
            for (int j = 0; j < grid_.size[1]; ++j) {
                const std::uint8_t* row = &inside.voxels[grid_.offset({0, j, k})];
                std::uint32_t* brick = &brick_of_[size_[0] * (std::uint32_t(j) / kEdge + std::size_t(size_[1]) * bk)];
                for (int i = 0; i < grid_.size[0]; ++i)
                    brick[std::uint32_t(i) / kEdge] |= row[i];
            }
    });
    bricks_.resize(1);
    std::size_t n = 0;
    for (std::uint32_t k = 0; k < size_[2]; ++k)
        for (std::uint32_t j = 0; j < size_[1]; ++j)
            for (std::uint32_t i = 0; i < size_[0]; ++i, ++n)
                if (brick_of_[n]) {
                    brick_of_[n] = std::uint32_t(bricks_.size());
                    bricks_.push_back({{}, {int(i * kEdge), int(j * kEdge), int(k * kEdge)}});
                }
    if (placeCount() > std::numeric_limits<std::uint32_t>::max())
        throw Error(ErrorCode::no_memory, "the lumen has more than 4294967295 voxels");
}

/// Notes the bricks around each.
void BrickGrid::join()
{
    tbb::parallel_for(std::size_t(1), bricks_.size(), [&](std::size_t n) {
        Brick& brick = bricks_[n];
        std::array<std::uint32_t, 3> at;
        for (std::size_t d = 0; d < 3; ++d)
            at[d] = std::uint32_t(brick.first[d]) / kEdge;
        for (std::size_t d = 0; d < 3; ++d)
            for (const std::uint32_t up : {0U, 1U}) {
                std::array<std::uint32_t, 3> beside = at;
                beside[d] += 2 * up - 1;  // below 0 it is beyond the last
                brick.begin[2 * d + up] =
                    beside[d] < size_[d] ? brickAt(beside[0], beside[1], beside[2]) * kVoxels : kNowhere;
            }
        brick.begin[6] = std::uint32_t(n) * kVoxels;
    });
}

}  // namespace vicon::steps
