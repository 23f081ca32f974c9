#include "tissue/faint_walls.h"

#include <algorithm>
#include <cmath>

#include "grid/neighbours.h"
#include "grid/thin_holes.h"
#include "tissue/mixture.h"

namespace vicon::steps {
namespace {

constexpr float kClosed = 0.75F;

bool isBeside(const Stool& stool, std::size_t voxel, const Grid& grid)
{
    return anyInCube(grid.indexOf(voxel), 1, [&](Index3 v) {
        const std::size_t n = grid.contains(v) ? grid.offset(v) : voxel;
        return std::ranges::binary_search(stool.dense, n) || std::ranges::binary_search(stool.mixed, n);
    });
}

}  // namespace

std::vector<FaintWall> closeFaintWalls(const InsideVolume& labels, const Stool& stool, TissueVolume& tissue,
                                       InsideVolume& lumen)
{
    const Grid& grid = lumen.grid;
    const double face_mm2 = std::pow(grid.voxelVolume_mm3(), 2.0 / 3);
    std::vector<FaintWall> walls;
    for (const ThinHole& hole : findThinHoles(tissue, lumen)) {
        const auto isLabelled = [&](std::size_t n) { return labels.voxels[n] != kOutside; };
        const auto isStool = [&](std::size_t n) { return isBeside(stool, n, grid); };
        if ((hole.only_way && std::ranges::all_of(hole.voxels, isLabelled)) ||
            std::ranges::any_of(hole.voxels, isStool))
            continue;
        for (const std::size_t n : hole.voxels) {
            lumen.voxels[n] = kOutside;
            tissue.voxels[n] = std::max(tissue.voxels[n], std::uint8_t(kClosed * kWhole));
        }
        walls.push_back({middleOf(hole, grid), face_mm2 * double(hole.voxels.size()) / 2});
    }
    return walls;
}

}  // namespace vicon::steps
