#include "vicon/steps/densities_around.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "grid/allocate.h"
#include "grid/lattice.h"

namespace vicon::steps {
namespace {

// A wall field reads 6 voxels beyond the labels at most: 1 of padding, 2 around a meniscus, 1 beside, 2 across a fold.
constexpr int kBeyond_voxels = 8;

}  // namespace

HuVolume densitiesAround(const HuVolume& volume, const Grid& part)
{
    const Index3 at = latticeOffset(part, volume.grid);
    const std::array<int, 3> first{at.i, at.j, at.k};
    std::array<int, 3> lower;
    Grid grid = volume.grid;
    for (std::size_t d = 0; d < 3; ++d) {
        lower[d] = std::max(0, first[d] - kBeyond_voxels);
        grid.size[d] = std::min(volume.grid.size[d], first[d] + part.size[d] + kBeyond_voxels) - lower[d];
    }
    grid.origin_mm = volume.grid.pointAt(Index3{lower[0], lower[1], lower[2]});
    auto out = makeVolume<std::int16_t>(grid);
    tbb::parallel_for(0, grid.size[2], [&](int k) {
        for (int j = 0; j < grid.size[1]; ++j)
            std::copy_n(&volume.at({lower[0], lower[1] + j, lower[2] + k}), grid.size[0], &out.at({0, j, k}));
    });
    return out;
}

}  // namespace vicon::steps
