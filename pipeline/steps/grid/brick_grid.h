#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "vicon/core/volume.h"

namespace vicon::steps {

/// The inside voxels of a mask in bricks of 4 x 4 x 4, brick by brick: what lies beside each other in space does so in
/// memory, a layer of a brick of floats in one cache line, and where nothing is inside nothing is kept. A voxel's place
/// is its number in that order. Places of a brick's voxels that are outside exist too; all voxels without a brick share
/// the first one, whose places are kNowhere and on.
class BrickGrid {
public:
    // A definition: 4 voxels an edge, and the place of what no brick holds.
    static constexpr std::uint32_t kEdge = 4, kVoxels = kEdge * kEdge * kEdge;
    static constexpr std::uint32_t kNowhere = 0;

    /// Throws std::bad_alloc, and Error{no_memory} for more voxels than 32 bits can tell.
    explicit BrickGrid(const InsideVolume& inside);

    const Grid& grid() const { return grid_; }
    /// Places, of all bricks and of the one that stands for all outside.
    std::size_t placeCount() const { return bricks_.size() * kVoxels; }
    std::uint32_t placeOf(Index3 v) const
    {
        const std::array<std::uint32_t, 3> at{std::uint32_t(v.i), std::uint32_t(v.j), std::uint32_t(v.k)};
        return brickAt(at[0] / kEdge, at[1] / kEdge, at[2] / kEdge) * kVoxels +
               (at[0] % kEdge + kEdge * (at[1] % kEdge + kEdge * (at[2] % kEdge)));
    }
    /// The voxel at a place of a brick, which may lie beyond the grid's last.
    Index3 voxelAt(std::uint32_t place) const
    {
        const auto& first = bricks_[place / kVoxels].first;
        const std::uint32_t n = place % kVoxels;
        return {first[0] + int(n % kEdge), first[1] + int(n / kEdge % kEdge), first[2] + int(n / (kEdge * kEdge))};
    }
    /// Places of the six face neighbours: -x, +x, -y, +y, -z, +z. Of a place in a brick that is not kNowhere's.
    std::array<std::uint32_t, 6> around(std::uint32_t place) const
    {
        const Brick& brick = bricks_[place / kVoxels];
        const auto& steps = kSteps[place % kVoxels];
        std::array<std::uint32_t, 6> places;
        for (std::size_t n = 0; n < 6; ++n)
            places[n] = brick.begin[steps[n].brick] + steps[n].voxel;
        return places;
    }
    /// Calls use(i, place, count) for the voxels of a row that lie in bricks, from voxel i on, brick by brick.
    template <class Use>
    void forEachRun(int j, int k, Use use) const
    {
        const std::uint32_t in_brick = kEdge * (std::uint32_t(j) % kEdge + kEdge * (std::uint32_t(k) % kEdge));
        for (std::uint32_t b = 0; b < size_[0]; ++b)
            if (const std::uint32_t brick = brickAt(b, std::uint32_t(j) / kEdge, std::uint32_t(k) / kEdge)) {
                const int i = int(b * kEdge);
                use(i, brick * kVoxels + in_brick, std::min(int(kEdge), grid_.size[0] - i));
            }
    }
    /// Asks for the memory that around() looks at.
    void fetch(std::uint32_t place) const { __builtin_prefetch(&bricks_[place / kVoxels]); }

private:
    struct Brick {
        std::array<std::uint32_t, 7> begin{};  ///< first place of the brick on each side, and last its own
        std::array<std::int32_t, 3> first{};   ///< its first voxel
    };
    struct Step {
        std::uint8_t brick, voxel;
    };
    static constexpr std::array<std::array<Step, 6>, kVoxels> steps();
    static const std::array<std::array<Step, 6>, kVoxels> kSteps;

    std::uint32_t brickAt(std::uint32_t i, std::uint32_t j, std::uint32_t k) const
    {
        return brick_of_[i + size_[0] * (j + std::size_t(size_[1]) * k)];
    }
    void number(const InsideVolume& inside);
    void join();

    Grid grid_;
    std::array<std::uint32_t, 3> size_{};  ///< bricks along each axis
    std::vector<std::uint32_t> brick_of_;  ///< number of each brick of the box, 0 where nothing is inside
    std::vector<Brick> bricks_;
};

}  // namespace vicon::steps
