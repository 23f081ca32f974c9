#include "tissue/faint_walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "grid/neighbours.h"
#include "grid/thin_holes.h"
#include "tissue/mixture.h"

namespace vicon::steps {
namespace {

/// The least fraction of tissue in a hole that is closed: halfway from the lumen's edge to tissue.
constexpr float kClosed = 0.75F;
/// The layer of a level in coarse voxels, on both sides of its middle.
constexpr int kLevel_voxels = 4;
/// So far behind a hole's edge its surroundings are looked at.
constexpr int kRim_voxels = 2;
/// The largest hole on ctc-prone has 19 mm2.
constexpr double kMost_mm2 = 100;

bool isBeside(const Stool& stool, std::size_t voxel, const Grid& grid)
{
    return anyInCube(grid.indexOf(voxel), 1, [&](Index3 v) {
        const std::size_t n = grid.contains(v) ? grid.offset(v) : voxel;
        return std::ranges::binary_search(stool.dense, n) || std::ranges::binary_search(stool.mixed, n);
    });
}

/// Whether gas lies above most of a hole, and fluid under it.
bool isLevel(const ThinHole& hole, const InsideVolume& lumen, const DownAxis& down)
{
    const auto lies = [&](Index3 v, int sign, InsideLabel label) {
        for (int n = 1; n <= kLevel_voxels; ++n)
            if (lumen.valueOr(down.moved(v, sign * n), kOutside) == label)
                return true;
        return false;
    };
    const auto count = std::ranges::count_if(hole.voxels, [&](std::size_t n) {
        const Index3 v = lumen.grid.indexOf(n);
        return lies(v, -1, kGas) && lies(v, 1, kFluid);
    });
    return 2 * std::size_t(count) >= hole.voxels.size();
}

/// Whether most of what surrounds a hole is a sheet with lumen above and below, as a fold is, and not the colon's wall.
bool isInSheet(const ThinHole& hole, const InsideVolume& lumen, const DownAxis& down)
{
    const Grid& grid = lumen.grid;
    const ContinuousIndex3 middle = grid.continuousIndexAt(middleOf(hole, grid));
    const auto isLumen = [&](Index3 v) { return lumen.valueOr(v, kOutside) != kOutside; };
    const auto opens = [&](Index3 v, int sign) {
        for (int n = 1; n <= kLevel_voxels; ++n)
            if (isLumen(down.moved(v, sign * n)))
                return true;
        return false;
    };
    std::size_t rim = 0, thin = 0;
    for (const std::size_t n : hole.voxels)
        forEachInCube(grid.indexOf(n), 1, [&](Index3 v) {
            if (isLumen(v) || down.along(v) != down.along(grid.indexOf(n)))
                return;
            std::array<double, 3> out{v.i - middle.i, v.j - middle.j, v.k - middle.k};
            out[std::size_t(down.axis)] = 0;
            const double away = std::max(1e-9, std::hypot(out[0], out[1], out[2]));
            const auto step = [&](std::size_t a) { return int(std::lround(kRim_voxels * out[a] / away)); };
            const Index3 behind = shifted(v, {step(0), step(1), step(2)});
            ++rim;
            thin += !isLumen(behind) && opens(behind, -1) && opens(behind, 1);
        });
    return 2 * thin >= rim && rim > 0;
}

}  // namespace

std::vector<ClosedWall> closeFaintWalls(const InsideVolume& labels, const Stool& stool, const DownAxis& down,
                                        TissueVolume& tissue, InsideVolume& lumen)
{
    const Grid& grid = lumen.grid;
    const double face_mm2 = std::pow(grid.voxelVolume_mm3(), 2.0 / 3);
    std::vector<ClosedWall> walls;
    for (const ThinHole& hole : findThinHoles(tissue, lumen)) {
        const double area_mm2 = face_mm2 * double(hole.voxels.size()) / 2;
        const auto isLabelled = [&](std::size_t n) { return labels.voxels[n] != kOutside; };
        const auto isStool = [&](std::size_t n) { return isBeside(stool, n, grid); };
        if (area_mm2 > kMost_mm2 || (hole.only_way && std::ranges::all_of(hole.voxels, isLabelled)) ||
            std::ranges::any_of(hole.voxels, isStool) || (isLevel(hole, lumen, down) && !isInSheet(hole, lumen, down)))
            continue;
        ClosedWall closed{{middleOf(hole, grid), area_mm2}, {}};
        for (const std::size_t n : hole.voxels)
            closed.voxels.push_back(closeVoxel(n, kClosed, tissue, lumen));
        walls.push_back(std::move(closed));
    }
    return walls;
}

}  // namespace vicon::steps
