#include "tissue/faint_walls.h"

#include <algorithm>
#include <cmath>

#include "grid/neighbours.h"
#include "grid/thin_holes.h"
#include "tissue/mixture.h"

namespace vicon::steps {
namespace {

constexpr float kClosed = 0.75F;
/// The layer of a level in coarse voxels, on both sides of its middle.
constexpr int kLevel_voxels = 4;
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

}  // namespace

std::vector<FaintWall> closeFaintWalls(const InsideVolume& labels, const Stool& stool, const DownAxis& down,
                                       TissueVolume& tissue, InsideVolume& lumen)
{
    const Grid& grid = lumen.grid;
    const double face_mm2 = std::pow(grid.voxelVolume_mm3(), 2.0 / 3);
    std::vector<FaintWall> walls;
    for (const ThinHole& hole : findThinHoles(tissue, lumen)) {
        const double area_mm2 = face_mm2 * double(hole.voxels.size()) / 2;
        const auto isLabelled = [&](std::size_t n) { return labels.voxels[n] != kOutside; };
        const auto isStool = [&](std::size_t n) { return isBeside(stool, n, grid); };
        if (area_mm2 > kMost_mm2 || (hole.only_way && std::ranges::all_of(hole.voxels, isLabelled)) ||
            std::ranges::any_of(hole.voxels, isStool) || isLevel(hole, lumen, down))
            continue;
        for (const std::size_t n : hole.voxels) {
            lumen.voxels[n] = kOutside;
            tissue.voxels[n] = std::max(tissue.voxels[n], std::uint8_t(kClosed * kWhole));
        }
        walls.push_back({middleOf(hole, grid), area_mm2});
    }
    return walls;
}

}  // namespace vicon::steps
