#include "tissue/other_bowel.h"

#include <algorithm>
#include <iterator>

#include "grid/byte_rows.h"
#include "grid/neighbours.h"
#include "grid/voxel_lists.h"
#include "tissue/lumen_of_tissue.h"
#include "tissue/mixture.h"

namespace vicon::steps {
namespace {

/// Between two bowels that touch the fraction nowhere falls below this. Chosen on ctc-prone, where tagged small bowel
/// touches the caecum: 0.3 and 0.5 tell the same three apart but for a crack.
constexpr float kApart = 0.4F;
/// Smaller parts are specks.
constexpr std::size_t kLeast_voxels = 8;
/// Labels end a voxel within the wall's middle at most; whatever goes on for so many has no wall there.
constexpr int kOpen_voxels = 2;
/// The share of a part's surface that goes on: 0.06 to 0.08 of what was cut off from small bowel (ctc-prone, three
/// places), 0.001 of the colon itself.
constexpr double kLeastOpen = 0.02;
/// The same of parts up to a size, 0.03 ml at the usual voxels, which have as much surface as content: a sliver of
/// small bowel behind a slit in the wall has 0.71 to 0.84 (ctc-prone, four places), a puddle of the colon's own 0.29.
constexpr std::size_t kSliver_voxels = 100;
constexpr double kLeastOpenOfSliver = 0.5;

/// Components of the labels where the fraction is below kApart.
RunLabels partsApart(const TissueVolume& tissue, const InsideVolume& inside)
{
    const int nx = inside.grid.size[0];
    const auto scan = [&](int j, int k, std::vector<VoxelRun>& runs) {
        const std::size_t begin = inside.grid.offset({0, j, k});
        const auto in = [&](int i) {
            const std::size_t n = begin + std::size_t(i);
            return inside.voxels[n] != kOutside && float(tissue.voxels[n]) < kApart * kWhole;
        };
        const std::uint8_t* row = &inside.voxels[begin];
        for (int i = firstOther(row, 0, nx, kOutside); i < nx; i = firstOther(row, i + 1, nx, kOutside)) {
            if (!in(i))
                continue;
            VoxelRun run{.begin = i};
            for (; i < nx && in(i); ++i)
                run.sum += inside.voxels[begin + std::size_t(i)] == kGas ? 1.0F : 0.0F;
            run.end = i;
            runs.push_back(run);
        }
    };
    return labelRuns(inside.grid.size, scan, Neighbours::faces);
}

/// What lies beside voxels and is wanted, in order.
template <class Wanted>
std::vector<std::size_t> beside(const Grid& grid, const std::vector<std::size_t>& voxels, Wanted wanted)
{
    std::vector<std::size_t> found;
    for (const std::size_t n : voxels)
        forEachOverFaces(grid, n, [&](std::size_t other) {
            if (wanted(other))
                found.push_back(other);
        });
    return sortedOnce(std::move(found));
}

/// Which share of a part's surface goes on without a wall, beyond the labels.
double openShare(const std::vector<std::size_t>& part, const TissueVolume& tissue, const InsideVolume& inside)
{
    const auto isNew = [](const std::vector<std::size_t>& voxels) {
        return [&voxels](std::size_t n) { return !std::binary_search(voxels.begin(), voxels.end(), n); };
    };
    const auto isFree = [&](std::size_t n) { return inside.voxels[n] == kOutside && tissue.voxels[n] < kHalfTissue; };
    const std::size_t surface = beside(inside.grid, part, isNew(part)).size();
    std::vector<std::size_t> layer = beside(inside.grid, part, isFree), before;
    for (int n = 1; n < kOpen_voxels; ++n) {
        before.insert(before.end(), layer.begin(), layer.end());
        std::sort(before.begin(), before.end());
        const auto isNotBefore = isNew(before);
        layer = beside(inside.grid, layer, [&](std::size_t m) { return isFree(m) && isNotBefore(m); });
    }
    return double(layer.size()) / double(std::max<std::size_t>(surface, 1));
}

}  // namespace

std::vector<std::size_t> otherBowel(const TissueVolume& tissue, const InsideVolume& inside, const RunLabels& pieces)
{
    const RunLabels parts = partsApart(tissue, inside);
    const std::vector<bool> is_largest = largestOfPieces(pieces, parts);
    std::vector<std::size_t> all;
    for (std::size_t n = 0; n < parts.components.size(); ++n) {
        const RunComponent& part = parts.components[n];
        if (is_largest[n] || part.voxels < kLeast_voxels || part.sum > 0)
            continue;
        const std::vector<std::size_t> voxels = voxelsOf(parts, std::uint32_t(n), inside.grid);
        if (openShare(voxels, tissue, inside) < (voxels.size() > kSliver_voxels ? kLeastOpen : kLeastOpenOfSliver))
            continue;
        // The thin wall is no lumen either.
        const std::vector<std::size_t> wall = beside(inside.grid, voxels, [&](std::size_t m) {
            return inside.voxels[m] != kOutside && float(tissue.voxels[m]) >= kApart * kWhole;
        });
        all.insert(all.end(), voxels.begin(), voxels.end());
        all.insert(all.end(), wall.begin(), wall.end());
    }
    return sortedOnce(std::move(all));
}

}  // namespace vicon::steps
