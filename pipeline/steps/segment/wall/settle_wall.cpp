#include "segment/wall/settle_wall.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "grid/mask.h"
#include "grid/neighbours.h"
#include "grid/voxel_lists.h"
#include "segment/wall/trim_lumen.h"

namespace vicon::steps {
namespace {

// No case recorded; reason: from a blur of 0.8 mm sigma. Held by
// Segment.FaintFluidDoesNotMoveTheWallOfABrightPoolItRunsInto. Half and double keep the lumen of the three cases
// (CONTRIBUTING.md) to Dice 0.9998.

/// How deep the wall under fluid is moved inwards at most, in voxels: the faintest pool's half-way density lies at most
/// that far out on a blurred edge.
constexpr int kMostLayers = 2;
/// Gas two voxels away is 5 % of what lies in a voxel, 60 to 80 HU: little against half of this contrast.
constexpr double kBright_hu = 400;
/// Where a pool is fainter than the rest of it, its density is the highest this near.
constexpr int kNear_voxels = 2;

double brightestNear(const WallField& wall, const InsideVolume& inside, Index3 v)
{
    double hu = -1e9;
    forEachInCube(v, kNear_voxels, [&](Index3 n) {
        if (inside.valueOr(n, kOutside) == kFluid)
            hu = std::max(hu, wall.hu(n, hu));
    });
    return hu;
}

/// Whether the blur of gas near a voxel of fluid takes more from its density than half-way allows.
bool besideGas(const InsideVolume& inside, Index3 v, double contrast_hu)
{
    const int reach = contrast_hu < kBright_hu ? 2 : 1;
    return anyInCube(v, reach, [&](Index3 n) { return inside.valueOr(n, kOutside) == kGas; });
}

/// Whether a voxel is fluid beside the outside whose density is nearer to tissue's than to its own pool's.
bool isTooFaint(const WallField& wall, double tissue_hu, const InsideVolume& inside, Index3 v)
{
    if (!besideOther(inside, v))
        return false;
    const double hu = wall.hu(v, tissue_hu), pool_hu = wall.poolDensity(v);
    return hu < (tissue_hu + pool_hu) / 2 && !besideGas(inside, v, pool_hu - tissue_hu) &&
           hu < (tissue_hu + brightestNear(wall, inside, v)) / 2;
}

std::vector<std::size_t> tooFaint(const WallField& wall, double tissue_hu, const InsideVolume& inside)
{
    const auto slice = std::size_t(inside.grid.size[0]) * std::size_t(inside.grid.size[1]);
    std::vector<std::vector<std::size_t>> slices(std::size_t(inside.grid.size[2]), std::vector<std::size_t>{});
    tbb::parallel_for(std::size_t(0), slices.size(), [&](std::size_t k) {
        for (std::size_t n = k * slice; n < (k + 1) * slice; ++n)
            if (inside.voxels[n] == kFluid && isTooFaint(wall, tissue_hu, inside, inside.grid.indexOf(n)))
                slices[k].push_back(n);
    });
    std::vector<std::size_t> all;
    for (const auto& here : slices)
        all.insert(all.end(), here.begin(), here.end());
    return all;
}

/// The same where voxels were taken away since: the others have nothing new beside them, and nothing brighter near.
std::vector<std::size_t> tooFaintBeside(const std::vector<std::size_t>& taken, const WallField& wall, double tissue_hu,
                                        const InsideVolume& inside)
{
    std::vector<std::size_t> beside;
    for (const std::size_t n : taken)
        forEachOverFaces(inside.grid, n, [&](std::size_t m) {
            if (inside.voxels[m] == kFluid)
                beside.push_back(m);
        });
    beside = sortedOnce(std::move(beside));
    std::erase_if(beside, [&](std::size_t n) { return !isTooFaint(wall, tissue_hu, inside, inside.grid.indexOf(n)); });
    return beside;
}

}  // namespace

void settleFluidWall(const HuVolume& volume, const WallDensities& densities, int pieces, InsideVolume& inside)
{
    std::vector<std::size_t> taken, last;
    {
        const WallField wall(volume, inside, densities);
        for (int layer = 0; layer < kMostLayers; ++layer) {
            const std::vector<std::size_t> faint = layer == 0 ? tooFaint(wall, densities.tissue_hu, inside)
                                                              : tooFaintBeside(last, wall, densities.tissue_hu, inside);
            for (const std::size_t n : faint)
                inside.voxels[n] = kOutside;
            taken.insert(taken.end(), faint.begin(), faint.end());
            last = faint;
        }
    }
    trimLumen(taken, pieces, inside);
}

}  // namespace vicon::steps
