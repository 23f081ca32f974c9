#include "quality/lumen_profile.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vicon::steps {
namespace {

/// The lumen on blocks of two voxels along each axis, with a layer of empty blocks around.
struct Blocks {
    std::array<std::ptrdiff_t, 3> size{};
    std::vector<std::uint8_t> gas, fluid;  ///< voxels of each kind in a block
    std::array<std::ptrdiff_t, 3> stride() const { return {1, size[0], size[0] * size[1]}; }
    std::size_t of(Index3 voxel) const
    {
        return std::size_t((voxel.i / 2 + 1) + size[0] * ((voxel.j / 2 + 1) + size[1] * (voxel.k / 2 + 1)));
    }
};

Blocks blocksOf(const InsideVolume& inside)
{
    Blocks blocks;
    for (std::size_t a = 0; a < 3; ++a)
        blocks.size[a] = (inside.grid.size[a] + 1) / 2 + 2;
    const auto count = std::size_t(blocks.size[0] * blocks.size[1] * blocks.size[2]);
    blocks.gas.assign(count, 0);
    blocks.fluid.assign(count, 0);
    tbb::parallel_for(0, (inside.grid.size[2] + 1) / 2, [&](int layer) {
        for (int k = 2 * layer; k < std::min(2 * layer + 2, inside.grid.size[2]); ++k)
            for (int j = 0; j < inside.grid.size[1]; ++j) {
                const std::uint8_t* row = &inside.voxels[inside.grid.offset({0, j, k})];
                for (int i = 0; i < inside.grid.size[0]; ++i)
                    if (row[i] != kOutside)
                        ++(row[i] == kFluid ? blocks.fluid : blocks.gas)[blocks.of({i, j, k})];
            }
    });
    return blocks;
}

constexpr std::uint16_t kUnreached = std::numeric_limits<std::uint16_t>::max();  // no station

}  // namespace

LumenProfile profileOf(const InsideVolume& inside, const Skeleton& skeleton)
{
    const Blocks blocks = blocksOf(inside);
    std::vector<std::uint16_t> station(blocks.gas.size(), kUnreached);
    std::vector<std::size_t> front, next;
    for (const SkeletonPiece& piece : skeleton.pieces)
        for (const SkeletonPoint& p : piece.points) {
            const Index3 v = inside.grid.indexAt(p.position_mm);
            if (piece.bridge || !inside.grid.contains(v) || station[blocks.of(v)] != kUnreached)
                continue;
            station[blocks.of(v)] = std::uint16_t(std::min(p.station_mm, double(kUnreached - 1)));
            front.push_back(blocks.of(v));
        }
    while (!front.empty()) {
        next.clear();
        for (const std::size_t block : front)
            for (const std::ptrdiff_t step : blocks.stride())
                for (const std::ptrdiff_t side : {-step, step}) {
                    const std::size_t beside = block + std::size_t(side);
                    if (station[beside] != kUnreached || blocks.gas[beside] + blocks.fluid[beside] == 0)
                        continue;
                    station[beside] = station[block];
                    next.push_back(beside);
                }
        front.swap(next);
    }
    LumenProfile profile;
    profile.volume_mm3.assign(std::size_t(skeleton.length_mm()) + 1, 0);
    profile.fluid_mm3 = profile.volume_mm3;
    const double voxel_mm3 = inside.grid.voxelVolume_mm3();
    for (std::size_t n = 0; n < station.size(); ++n) {
        const int lumen = blocks.gas[n] + blocks.fluid[n];
        if (lumen == 0)
            continue;
        if (station[n] == kUnreached) {
            profile.unreached_mm3 += lumen * voxel_mm3;
            continue;
        }
        const auto at = std::min(std::size_t(station[n]), profile.volume_mm3.size() - 1);
        profile.volume_mm3[at] += lumen * voxel_mm3;
        profile.fluid_mm3[at] += blocks.fluid[n] * voxel_mm3;
    }
    return profile;
}

}  // namespace vicon::steps
