#include "tissue/lumen_of_tissue.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "grid/allocate.h"
#include "grid/mask.h"
#include "grid/neighbours.h"
#include "grid/run_labels.h"
#include "grid/sparse_voxels.h"
#include "grid/voxel_lists.h"
#include "grid/voxels_where.h"
#include "grid/wall_values.h"
#include "tissue/mixture.h"
#include "vicon/core/disjoint_sets.h"

namespace vicon::steps {
namespace {

// Held by tissue_test: bowel that the labels were cut off from, a recess with a wall of its own. Half and double
// of each move the wall of ctc-prone by 0.0006 mm in the mean, that of phantom 215 by less.

/// How far the lumen may grow beyond its labels.
constexpr int kMostLayers = 2;

/// Those of `voxels` that hang together, over faces, with the outside or are many; both in order.
std::vector<std::size_t> withoutSpecks(const std::vector<std::size_t>& voxels, const InsideVolume& inside)
{
    std::vector<std::uint8_t> seen(voxels.size(), 0);
    std::vector<std::size_t> kept, set;
    for (std::size_t first = 0; first < voxels.size(); ++first) {
        if (seen[first])
            continue;
        seen[first] = 1;
        set.assign(1, first);
        bool on_wall = false;
        for (std::size_t n = 0; n < set.size(); ++n)
            forEachOverFaces(inside.grid, voxels[set[n]], [&](std::size_t beside) {
                on_wall = on_wall || inside.voxels[beside] == kOutside;
                const auto at = std::lower_bound(voxels.begin(), voxels.end(), beside);
                if (at == voxels.end() || *at != beside || seen[std::size_t(at - voxels.begin())])
                    return;
                seen[std::size_t(at - voxels.begin())] = 1;
                set.push_back(std::size_t(at - voxels.begin()));
            });
        if (on_wall || set.size() > kSpeck_voxels)
            for (const std::size_t n : set)
                kept.push_back(voxels[n]);
    }
    std::sort(kept.begin(), kept.end());
    return kept;
}

/// Which parts of the lumen the wall cuts off their piece without loss: specks, and what hangs on what is left out.
std::vector<bool> lostParts(const RunLabels& parts, const std::vector<bool>& is_largest, const Grid& grid,
                            const std::vector<std::size_t>& left_out)
{
    std::vector<bool> lost(parts.components.size());
    for (std::size_t part = 0; part < lost.size(); ++part)
        lost[part] = !is_largest[part] && parts.components[part].voxels <= kSpeck_voxels;
    for (const std::size_t n : left_out)
        forEachOverFaces(grid, n, [&](std::size_t beside) {
            const int part = parts.labelAt(grid.indexOf(beside));
            if (part >= 0 && !is_largest[std::size_t(part)])
                lost[std::size_t(part)] = true;
        });
    return lost;
}

/// A wall that would cut more off its piece is none that can be told: the labels stay as they were there.
void restoreCuts(const SparseVoxels& walls, const InsideVolume& inside, const RunLabels& pieces,
                 const std::vector<std::size_t>& left_out, InsideVolume& lumen)
{
    const RunLabels parts = labelLumen(lumen, Neighbours::faces);
    const std::vector<bool> is_largest = largestOfPieces(pieces, parts);
    if (std::ranges::all_of(is_largest, std::identity()))
        return;
    const std::vector<bool> lost = lostParts(parts, is_largest, inside.grid, left_out);
    for (std::size_t part = 0; part < lost.size(); ++part)
        if (lost[part])
            for (const std::size_t n : voxelsOf(parts, std::uint32_t(part), inside.grid))
                lumen.voxels[n] = kOutside;
    DisjointSets sets(walls.size());
    for (std::size_t n = 0; n < walls.size(); ++n)
        walls.forNear(walls[n], 1, [&](std::size_t other) { sets.join(std::uint32_t(n), std::uint32_t(other)); });
    std::vector<bool> cuts(walls.size(), false);
    for (std::size_t n = 0; n < walls.size(); ++n)
        forEachOverFaces(inside.grid, walls[n], [&](std::size_t beside) {
            const int part = parts.labelAt(inside.grid.indexOf(beside));
            if (part >= 0 && !is_largest[std::size_t(part)] && !lost[std::size_t(part)])
                cuts[sets.rootOf(std::uint32_t(n))] = true;
        });
    for (std::size_t n = 0; n < walls.size(); ++n)
        if (cuts[sets.rootOf(std::uint32_t(n))])
            lumen.voxels[walls[n]] = inside.voxels[walls[n]];
}

/// The lumen's growth into what its labels leave out.
class Growth {
public:
    Growth(const TissueVolume& tissue, const InsideVolume& inside, const RunLabels& pieces, InsideVolume& lumen)
        : tissue_(tissue), inside_(inside), pieces_(pieces), lumen_(lumen)
    {
    }

    void run()
    {
        std::vector<std::size_t> front =
            voxelsWhere(inside_.grid, tissue_.voxels, std::uint8_t(kWhole),
                        [&](std::size_t n) { return mayBecomeLumen(n) && labelBeside(n) != kOutside; });
        for (int layer = 0; layer < kMostLayers; ++layer) {
            std::erase_if(front, [&](std::size_t n) { return areNearTwoPieces(pieces_, inside_.grid, {&n, 1}); });
            std::vector<std::uint8_t> labels(front.size());
            std::transform(front.begin(), front.end(), labels.begin(), [&](std::size_t n) { return labelBeside(n); });
            for (std::size_t n = 0; n < front.size(); ++n)
                lumen_.voxels[front[n]] = labels[n];
            std::vector<std::size_t> next;
            for (const std::size_t n : front)
                forEachOverFaces(inside_.grid, n, [&](std::size_t beside) {
                    if (lumen_.voxels[beside] == kOutside && mayBecomeLumen(beside))
                        next.push_back(beside);
                });
            front = sortedOnce(std::move(next));
        }
    }

private:
    bool mayBecomeLumen(std::size_t n) const
    {
        return inside_.voxels[n] == kOutside && tissue_.voxels[n] < kHalfTissue;
    }

    /// The label of what lies beside a voxel; kOutside where nothing does.
    std::uint8_t labelBeside(std::size_t n) const
    {
        std::uint8_t label = kOutside;
        forEachOverFaces(inside_.grid, n, [&](std::size_t beside) { label = std::max(label, lumen_.voxels[beside]); });
        return label;
    }

    const TissueVolume& tissue_;
    const InsideVolume& inside_;
    const RunLabels& pieces_;
    InsideVolume& lumen_;
};

}  // namespace

bool areNearTwoPieces(const RunLabels& pieces, const Grid& grid, std::span<const std::size_t> voxels)
{
    if (pieces.components.size() < 2)
        return false;
    int piece = -1;
    return std::ranges::any_of(voxels, [&](std::size_t n) {
        return anyInCube(grid.indexOf(n), kMostLayers + 1, [&](Index3 v) {
            const int there = grid.contains(v) ? pieces.labelAt(v) : -1;
            if (there < 0 || there == piece)
                return false;
            return std::exchange(piece, there) >= 0;
        });
    });
}

std::vector<bool> largestOfPieces(const RunLabels& pieces, const RunLabels& lumen)
{
    std::vector<std::uint32_t> piece_of(lumen.components.size(), 0);
    for (int k = 0; k < lumen.size[2]; ++k)
        for (int j = 0; j < lumen.size[1]; ++j)
            for (std::size_t n = lumen.row_begin[lumen.row(j, k)]; n < lumen.row_begin[lumen.row(j, k) + 1]; ++n)
                piece_of[lumen.runs[n].label] = std::uint32_t(pieces.labelAt({lumen.runs[n].begin, j, k}));
    constexpr std::size_t kNone = SIZE_MAX;  // no part of the piece yet
    std::vector<std::size_t> largest(pieces.components.size(), kNone);
    for (std::size_t n = 0; n < piece_of.size(); ++n)
        if (std::size_t& of = largest[piece_of[n]];
            of == kNone || lumen.components[n].voxels > lumen.components[of].voxels)
            of = n;
    std::vector<bool> is_largest(lumen.components.size());
    for (std::size_t n = 0; n < piece_of.size(); ++n)
        is_largest[n] = n == largest[piece_of[n]];
    return is_largest;
}

InsideVolume lumenOf(const TissueVolume& tissue, const InsideVolume& inside, const RunLabels& pieces,
                     const std::vector<std::size_t>& left_out)
{
    InsideVolume lumen = inside;
    const auto isWall = [&](std::size_t n) { return tissue.voxels[n] >= kHalfTissue; };
    const SparseVoxels walls(inside.grid,
                             withoutSpecks(voxelsWhere(inside.grid, inside.voxels, kOutside, isWall), inside));
    for (std::size_t n = 0; n < walls.size(); ++n)
        lumen.voxels[walls[n]] = kOutside;
    for (const std::size_t n : left_out)
        lumen.voxels[n] = kOutside;
    restoreCuts(walls, inside, pieces, left_out, lumen);
    Growth(tissue, inside, pieces, lumen).run();
    return lumen;
}

Volume<std::int16_t> tissueValues(const TissueVolume& tissue, const InsideVolume& lumen)
{
    const auto [nx, ny, nz] = tissue.grid.size;
    auto values = makeVolume<std::int16_t>(Grid{.size = {nx + 2, ny + 2, nz + 2}}, std::int16_t(kWallScale));
    const RowsNearLumen rows(lumen);
    std::array<std::int16_t, 256> of_lumen{}, of_wall{};  // by the fraction
    for (std::size_t n = 0; n < of_lumen.size(); ++n) {
        const float value = (2 * float(n) / kWhole - 1) * kWallScale, least = WallField::kLeast * kWallScale;
        of_lumen[n] = std::int16_t(std::lround(std::clamp(value, -kWallScale, -least)));
        of_wall[n] = std::int16_t(std::lround(std::clamp(value, least, kWallScale)));
    }
    tbb::parallel_for(0, nz, [&, nx = nx, ny = ny](int k) {
        for (int j = 0; j < ny; ++j) {
            if (!rows.near(j, k))
                continue;
            const std::size_t begin = tissue.grid.offset({0, j, k});
            std::int16_t* row = &values.at({1, j + 1, k + 1});
            for (int i = 0; i < nx; ++i) {
                const std::size_t n = begin + std::size_t(i);
                row[i] = (lumen.voxels[n] != kOutside ? of_lumen : of_wall)[tissue.voxels[n]];
            }
        }
    });
    return values;
}

Vector3 tissueGradient(const TissueVolume& tissue, Index3 v)
{
    int i_sum = 0, j_sum = 0, k_sum = 0;
    for (int k = -1; k <= 1; ++k)
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) {
                const int value = tissue.valueOr({v.i + i, v.j + j, v.k + k}, std::uint8_t(kWhole));
                const auto weight = [](int a, int b) { return (2 - a * a) * (2 - b * b); };
                i_sum += i * weight(j, k) * value;
                j_sum += j * weight(i, k) * value;
                k_sum += k * weight(i, j) * value;
            }
    return {double(i_sum), double(j_sum), double(k_sum)};
}

}  // namespace vicon::steps
