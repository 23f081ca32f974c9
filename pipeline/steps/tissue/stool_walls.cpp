#include "tissue/stool_walls.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "grid/neighbours.h"
#include "grid/sparse_voxels.h"
#include "grid/voxel_lists.h"
#include "vicon/core/disjoint_sets.h"

namespace vicon::steps {
namespace {

// Chosen on ctc-prone, where residue lies on folds of 1.5 mm. Held by StoolWalls.

/// The thinnest wall that is drawn.
constexpr double kThinnestWall_mm = 1.5;
/// From gas to gas, through stool and what it lies on: folds have 2 to 3 mm, and their stool as much.
constexpr double kThinFold_mm = 5.5;
constexpr double kLeastOnFold = 0.15;  // of a lump's voxels
/// Gas this near to a lump is of its side; around a fold's free edge it is farther.
constexpr int kNear_voxels = 3;
/// Parts with fewer voxels are no side.
constexpr std::size_t kFewestOfSide = 6;

/// The sets that hang together over faces, edges and corners.
std::vector<std::vector<std::size_t>> connected(const Grid& grid, const std::vector<std::size_t>& voxels)
{
    const SparseVoxels sparse(grid, voxels);
    DisjointSets sets(voxels.size());
    for (std::size_t n = 0; n < voxels.size(); ++n)
        sparse.forNear(voxels[n], 1, [&](std::size_t m) { sets.join(std::uint32_t(n), std::uint32_t(m)); });
    std::map<std::uint32_t, std::vector<std::size_t>> by_root;
    for (std::size_t n = 0; n < voxels.size(); ++n)
        by_root[sets.rootOf(std::uint32_t(n))].push_back(voxels[n]);
    std::vector<std::vector<std::size_t>> all;
    for (auto& [root, set] : by_root)
        all.push_back(std::move(set));
    return all;
}

std::vector<std::size_t> lumenNear(const InsideVolume& inside, const std::vector<std::size_t>& lump)
{
    std::vector<std::size_t> near;
    for (const std::size_t n : lump)
        forEachInCube(inside.grid.indexOf(n), kNear_voxels, [&](Index3 v) {
            if (inside.valueOr(v, kOutside) != kOutside)
                near.push_back(inside.grid.offset(v));
        });
    return sortedOnce(std::move(near));
}

/// The voxels of a lump that lie within the thinnest wall before a part of the lumen.
void addWall(const Grid& grid, const SparseVoxels& lump, const std::vector<std::size_t>& side,
             std::vector<std::size_t>& wall)
{
    const double finest_mm = *std::min_element(grid.spacing_mm.begin(), grid.spacing_mm.end());
    const double reach_mm = kThinnestWall_mm + finest_mm / 2;
    for (const std::size_t n : side)
        lump.forNear(n, int(std::ceil(reach_mm / finest_mm)), [&](std::size_t m) {
            if (distance(grid.pointAt(grid.indexOf(n)), grid.pointAt(grid.indexOf(lump[m]))) <= reach_mm)
                wall.push_back(lump[m]);
        });
}

bool holds(const std::vector<std::size_t>& voxels, std::size_t n)
{
    return std::binary_search(voxels.begin(), voxels.end(), n);
}

/// A walk from stool to the lumen.
struct WayToLumen {
    double length_mm = 0;  ///< without any: infinite
    bool through_tissue = false;
};

WayToLumen wayToLumen(const InsideVolume& inside, const Stool& stool, Index3 from, Index3 direction)
{
    const double step_mm = stepLength_mm(inside.grid, direction);
    WayToLumen way;
    for (Index3 v = shifted(from, direction); way.length_mm < kThinFold_mm; v = shifted(v, direction)) {
        way.length_mm += step_mm;
        if (!inside.grid.contains(v))
            break;
        if (inside.at(v) != kOutside)
            return way;
        const std::size_t n = inside.grid.offset(v);
        way.through_tissue = way.through_tissue || (!holds(stool.dense, n) && !holds(stool.mixed, n));
    }
    return {std::numeric_limits<double>::infinity(), true};
}

/// Whether lumen lies before a voxel of stool, and again behind what it lies on.
bool isOnThinFold(const InsideVolume& inside, const Stool& stool, std::size_t n)
{
    const Index3 v = inside.grid.indexOf(n);
    return anyInCube({0, 0, 0}, 1, [&](Index3 d) {
        if (d == Index3{0, 0, 0})
            return false;
        const WayToLumen before = wayToLumen(inside, stool, v, d);
        if (before.through_tissue)
            return false;
        const WayToLumen behind = wayToLumen(inside, stool, v, {-d.i, -d.j, -d.k});
        return behind.through_tissue && before.length_mm + behind.length_mm <= kThinFold_mm;
    });
}

std::vector<std::size_t> allOf(const Stool& stool)
{
    std::vector<std::size_t> all;
    std::set_union(stool.dense.begin(), stool.dense.end(), stool.mixed.begin(), stool.mixed.end(),
                   std::back_inserter(all));
    return all;
}

}  // namespace

void leaveOnThinFolds(const InsideVolume& inside, Stool& stool)
{
    std::vector<std::size_t> left;
    for (const std::vector<std::size_t>& lump : connected(inside.grid, allOf(stool))) {
        const auto on_fold = std::count_if(lump.begin(), lump.end(), [&](std::size_t n) {
            return holds(stool.dense, n) && isOnThinFold(inside, stool, n);
        });
        if (double(on_fold) >= kLeastOnFold * double(lump.size()))
            left.insert(left.end(), lump.begin(), lump.end());
    }
    left = sortedOnce(std::move(left));
    std::set_intersection(stool.dense.begin(), stool.dense.end(), left.begin(), left.end(),
                          std::back_inserter(stool.left));
    stool.dense = without(stool.dense, left);
    stool.mixed = without(stool.mixed, left);
}

void keepWallsBehind(const InsideVolume& inside, Stool& stool)
{
    for (const std::vector<std::size_t>& lump : connected(inside.grid, allOf(stool))) {
        auto sides = connected(inside.grid, lumenNear(inside, lump));
        std::erase_if(sides, [](const auto& side) { return side.size() < kFewestOfSide; });
        std::sort(sides.begin(), sides.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
        const SparseVoxels voxels(inside.grid, lump);
        for (std::size_t n = 1; n < sides.size(); ++n)
            addWall(inside.grid, voxels, sides[n], stool.wall);
    }
    stool.wall = sortedOnce(std::move(stool.wall));
    stool.dense = without(stool.dense, stool.wall);
    stool.mixed = without(stool.mixed, stool.wall);
}

}  // namespace vicon::steps
