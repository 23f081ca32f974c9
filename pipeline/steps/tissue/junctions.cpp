#include "tissue/junctions.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

#include "tissue/subvoxels.h"

namespace vicon::steps {
namespace {

/// Voxels around a tile are solved with it, so that the tiles fit; no further than that they are those of another.
constexpr int kShared = 2;
constexpr int kMargin = kShared + Subvoxels::kBorder;
constexpr int kTile = Subvoxels::kEdge - 2 * kMargin;
/// From this fraction on a voxel may be wall, and those up to so far from it may hold some of it.
constexpr float kSomeWall = 0.4F;
constexpr int kBesideWall_voxels = 3;
/// What has gas so near on both sides along an axis is thin: 1.4 mm each. More leaves out polyps of 6 mm.
constexpr int kThin_voxels = 2;
/// Gas that is not labelled is that of a bubble: so far from it nothing is solved. Chosen on phantom 402 with bubbles.
constexpr int kBesideBubble_voxels = 4;
/// Voxels so near to the border of the labels' grid are left as they are.
constexpr int kBorder_voxels = 4;

struct SettledVoxel {
    std::size_t voxel;
    std::uint8_t value;
};

class Junctions {
public:
    Junctions(const Mixture& mixture, const FluidDensity& fluid, const std::vector<std::uint8_t>& near,
              const Subvoxels::Scan& scan, const TissueVolume& tissue)
        : mixture_(mixture), fluid_(fluid), near_(near), tissue_(tissue), boxes_(scan)
    {
    }

    /// The fractions of a tile that are others now.
    std::vector<SettledVoxel> solve(Index3 tile)
    {
        const Index3 first{tile.i * kTile - kMargin, tile.j * kTile - kMargin, tile.k * kTile - kMargin};
        std::vector<SettledVoxel> changed;
        Subvoxels& box = boxes_.local();
        if (!fill(first, box))
            return changed;
        box.solve();
        forBox(kMargin, [&](int i, int j, int k) {
            if (!box.at(i, j, k).is_solved || !box.isExplained(i, j, k))
                return;
            const std::size_t n = tissue_.grid.offset({first.i + i, first.j + j, first.k + k});
            changed.push_back({n, stored(double(box.tissue(i, j, k)))});
        });
        return changed;
    }

    std::vector<Index3> tiles() const
    {
        const auto [nx, ny, nz] = tissue_.grid.size;
        const auto tilesOf = [](int voxels) { return (voxels + kTile - 1) / kTile; };
        const Index3 count{tilesOf(nx), tilesOf(ny), tilesOf(nz)};
        std::vector<std::uint8_t> found(std::size_t(count.i) * std::size_t(count.j) * std::size_t(count.k));
        tbb::parallel_for(0, count.k, [&, nx = nx, ny = ny, nz = nz](int tk) {
            for (int k = tk * kTile; k < std::min(nz, (tk + 1) * kTile); ++k)
                for (int j = 0; j < ny; ++j)
                    for (int ti = 0; ti < count.i; ++ti) {
                        const int begin = ti * kTile, length = std::min(kTile, nx - begin);
                        if (std::memchr(&near_[tissue_.grid.offset({begin, j, k})], 1, std::size_t(length)) != nullptr)
                            found[std::size_t(ti) + std::size_t(count.i) * (std::size_t(j / kTile) +
                                                                            std::size_t(count.j) * std::size_t(tk))] =
                                1;
                    }
        });
        std::vector<Index3> tiles;
        for (std::size_t n = 0; n < found.size(); ++n)
            if (found[n]) {
                const int row = int(n) / count.i;
                tiles.push_back({int(n) % count.i, row % count.j, row / count.j});
            }
        return tiles;
    }

private:
    /// Calls use(i, j, k) for the voxels of a box, but not for those so near to its border.
    template <class Use>
    static void forBox(int border, Use use)
    {
        for (int k = border; k < Subvoxels::kEdge - border; ++k)
            for (int j = border; j < Subvoxels::kEdge - border; ++j)
                for (int i = border; i < Subvoxels::kEdge - border; ++i)
                    use(i, j, k);
    }

    /// @return whether there is anything to solve
    bool fill(Index3 first, Subvoxels& box) const
    {
        forBox(0, [&](int i, int j, int k) {
            const Index3 v{first.i + i, first.j + j, first.k + k};
            box.at(i, j, k) = {.hu = float(mixture_.hu(v)), .tissue = float(tissue_.valueOr(v, 255)) / kWhole};
        });
        const std::vector<std::uint8_t> is_beside_bubble = besideBubbles(first, box);
        bool any = false;
        forBox(Subvoxels::kBorder, [&](int i, int j, int k) {
            const Index3 v{first.i + i, first.j + j, first.k + k};
            if (is_beside_bubble[Subvoxels::voxel(i, j, k)] || !isInner(v) || near_[tissue_.grid.offset(v)] != 1 ||
                !isBesideWall(box, i, j, k) || isBetweenGas(v))
                return;
            box.at(i, j, k).is_solved = true;
            any = true;
        });
        return any && setFluid(first, box);
    }

    /// 1 near gas that is not the lumen's: over a bubble fluid hangs without a wall.
    std::vector<std::uint8_t> besideBubbles(Index3 first, Subvoxels& box) const
    {
        constexpr int kLast = Subvoxels::kEdge - 1;  // voxel of a row
        const double bubble_hu = (3 * mixture_.gas_hu + mixture_.tissue_hu) / 4;
        std::vector<std::uint8_t> is_beside(Subvoxels::voxel(kLast, kLast, kLast) + 1);
        forBox(0, [&](int i, int j, int k) {
            const Index3 v{first.i + i, first.j + j, first.k + k};
            if (double(box.at(i, j, k).hu) > bubble_hu || mixture_.inside.valueOr(v, kGas) != kOutside)
                return;
            const int begin = std::max(0, i - kBesideBubble_voxels), end = std::min(kLast, i + kBesideBubble_voxels);
            for (int bk = std::max(0, k - kBesideBubble_voxels); bk <= std::min(kLast, k + kBesideBubble_voxels); ++bk)
                for (int bj = std::max(0, j - kBesideBubble_voxels); bj <= std::min(kLast, j + kBesideBubble_voxels);
                     ++bj)
                    for (int bi = begin; bi <= end; ++bi)
                        is_beside[Subvoxels::voxel(bi, bj, bk)] = 1;
        });
        return is_beside;
    }

    bool isInner(Index3 v) const
    {
        const auto& size = tissue_.grid.size;
        return std::min({v.i, v.j, v.k, size[0] - 1 - v.i, size[1] - 1 - v.j, size[2] - 1 - v.k}) >= kBorder_voxels;
    }

    /// Whether gas is near on both sides. What is so thin there is a wall at least in part: fluid would fall.
    bool isBetweenGas(Index3 v) const
    {
        const auto reaches = [&](int axis, int side) {
            for (int n = 1; n <= kThin_voxels; ++n)
                if (mixture_.inside.at(beside(v, axis, side * n)) == kGas)
                    return true;
            return false;
        };
        if (mixture_.inside.at(v) == kGas)
            return false;
        for (int axis = 0; axis < 3; ++axis)
            if (reaches(axis, -1) && reaches(axis, 1))
                return true;
        return false;
    }

    static bool isBesideWall(Subvoxels& box, int i, int j, int k)
    {
        constexpr int r = kBesideWall_voxels;
        for (int dk = -r; dk <= r; ++dk)
            for (int dj = -r; dj <= r; ++dj)
                for (int di = -r; di <= r; ++di)
                    if (box.at(i + di, j + dj, k + dk).tissue > kSomeWall)
                        return true;
        return false;
    }

    /// Sets the density of fluid, in small blocks, as it changes little; where it is not known that of the fluid
    /// around.
    /// @return whether there is any
    bool setFluid(Index3 first, Subvoxels& box) const
    {
        constexpr int kBlock = 4, kBlocks = Subvoxels::kEdge / kBlock;  // voxels, and blocks in a box: 2.8 mm
        std::array<float, std::size_t(kBlocks) * kBlocks * kBlocks> blocks{};
        float sum = 0;
        int count = 0;
        for (std::size_t n = 0; n < blocks.size(); ++n) {
            const int b = int(n);
            const Index3 middle{first.i + kBlock * (b % kBlocks) + kBlock / 2,
                                first.j + kBlock * (b / kBlocks % kBlocks) + kBlock / 2,
                                first.k + kBlock * (b / (kBlocks * kBlocks)) + kBlock / 2};
            blocks[n] = tissue_.grid.contains(middle) ? float(fluid_.at(middle)) : 0;
            sum += blocks[n];
            count += blocks[n] > 0 ? 1 : 0;
        }
        if (count == 0)
            return false;
        forBox(0, [&](int i, int j, int k) {
            const int block = i / kBlock + kBlocks * (j / kBlock + kBlocks * (k / kBlock));
            const float hu = blocks[std::size_t(block)];
            box.at(i, j, k).fluid_hu = hu > 0 ? hu : sum / float(count);
        });
        return true;
    }

    const Mixture& mixture_;
    const FluidDensity& fluid_;
    const std::vector<std::uint8_t>& near_;
    const TissueVolume& tissue_;
    tbb::enumerable_thread_specific<Subvoxels> boxes_;
};

}  // namespace

void settleJunctions(const Mixture& mixture, const FluidDensity& fluid, const DownAxis& down,
                     const std::vector<std::uint8_t>& near, double blur_voxels, double noise_hu, TissueVolume& tissue)
{
    Junctions junctions(mixture, fluid, near,
                        {mixture.gas_hu, mixture.tissue_hu, noise_hu, blur_voxels, normalized(down.per_voxel)}, tissue);
    const std::vector<Index3> tiles = junctions.tiles();
    std::vector<std::vector<SettledVoxel>> changed(tiles.size());
    tbb::parallel_for(std::size_t(0), tiles.size(), [&](std::size_t n) { changed[n] = junctions.solve(tiles[n]); });
    for (const auto& tile : changed)
        for (const SettledVoxel& one : tile)
            tissue.voxels[one.voxel] = one.value;
}

}  // namespace vicon::steps
