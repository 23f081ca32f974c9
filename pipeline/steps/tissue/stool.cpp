#include "tissue/stool.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "grid/byte_rows.h"
#include "grid/neighbours.h"
#include "grid/voxel_lists.h"
#include "tissue/direct_step.h"
#include "tissue/enclosed.h"
#include "tissue/near_mask.h"

namespace vicon::steps {
namespace {

// Chosen on phantoms 3 and 301 with --stool and on ctc-prone. Held by Stool.

/// Of a lump's faces must look on gas. Lumps on the wall have .35 and more, a rectal tube .25, bone and bowel behind a
/// thin wall .2 at most.
constexpr double kLeastOpenShare = 0.26;
/// Brighter than tissue: contrast medium in vessels and mucosa is less.
constexpr double kBrightest_hu = 240;
constexpr double kSmallest_mm3 = 4;
/// Bubbles part a lump into pieces that lie this near.
constexpr int kApart_voxels = 2;
/// How near to stool a bubble of it lies.
constexpr int kBesideStool_voxels = 2;
/// Darker than fat by more than noise: air. It is seen this near to what it mixes with.
constexpr double kAirInStool_hu = -200;
constexpr int kNearAir_voxels = 2;

class StoolFinder {
public:
    StoolFinder(const Mixture& mixture, double bright_hu, double blur_mm)
        : mixture_(mixture),
          grid_(mixture.inside.grid),
          bright_hu_(bright_hu),
          step_(mixture, blur_mm),
          lump_(grid_.voxelCount(), kNone)
    {
        const double voxel_mm3 = grid_.voxelVolume_mm3();
        smallest_ = std::size_t(std::max(1.0, kSmallest_mm3 / voxel_mm3));
        largest_ = std::size_t(kLargestStool_mm3 / voxel_mm3);
    }

    Stool run()
    {
        for (const std::size_t seed : seeds())
            if (lump_[seed] == kNone)
                grow(seed);
        std::sort(found_.dense.begin(), found_.dense.end());
        findMixed();
        return std::move(found_);
    }

private:
    // Definitions: what is known of a voxel.
    static constexpr std::uint8_t kNone = 0, kGrowing = 1, kRefused = 2, kStool = 3;

    /// Bright voxels right behind gas, no wall between.
    std::vector<std::size_t> seeds() const
    {
        const auto [nx, ny, nz] = grid_.size;
        std::vector<std::vector<std::size_t>> slices(std::size_t(nz), std::vector<std::size_t>{});
        tbb::parallel_for(0, nz, [&, nx = nx, ny = ny](int k) {
            for (int j = 0; j < ny; ++j) {
                const std::uint8_t* row = &mixture_.inside.at({0, j, k});
                for (int i = firstOther(row, 0, nx, kOutside); i < nx; i = firstOther(row, i + 1, nx, kOutside))
                    if (row[i] == kGas)
                        for (const Index3 face : kFaces)
                            if (const int steps = stepsToBright({i, j, k}, face))
                                slices[std::size_t(k)].push_back(grid_.offset(along({i, j, k}, face, steps)));
            }
        });
        std::vector<std::size_t> all;
        for (const auto& slice : slices)
            all.insert(all.end(), slice.begin(), slice.end());
        return all;
    }

    bool isBright(Index3 v) const
    {
        return grid_.contains(v) && mixture_.inside.at(v) == kOutside && mixture_.hu(v) >= bright_hu_;
    }

    /// From gas to the first bright voxel in a direction, when the densities step straight into it; else 0.
    int stepsToBright(Index3 gas, Index3 direction) const
    {
        if (mixture_.inside.valueOr(shifted(gas, direction), kGas) != kOutside)
            return 0;
        int bright = 1;
        while (bright <= DirectStep::kFarthest_voxels && !isBright(along(gas, direction, bright)))
            ++bright;
        return bright <= DirectStep::kFarthest_voxels && step_.isDirect(gas, direction, bright) ? bright : 0;
    }

    /// Takes the bright voxels that hang together with a seed, bubbles between them, if they are a lump of stool.
    void grow(std::size_t seed)
    {
        std::vector<std::size_t> lump{seed};
        lump_[seed] = kGrowing;
        bool is_more = false;  // of what was too large
        for (std::size_t n = 0; n < lump.size() && lump.size() <= largest_ && !is_more; ++n)
            forEachInCube(grid_.indexOf(lump[n]), kApart_voxels, [&](Index3 v) {
                if (!isBright(v))
                    return;
                std::uint8_t& taken = lump_[grid_.offset(v)];
                is_more = is_more || taken == kRefused;
                if (taken == kNone) {
                    taken = kGrowing;
                    lump.push_back(grid_.offset(v));
                }
            });
        const bool is_stool = !is_more && lump.size() >= smallest_ && lump.size() <= largest_ &&
                              brightest_hu(lump) >= mixture_.tissue_hu + kBrightest_hu &&
                              openShare(lump) >= kLeastOpenShare;
        for (const std::size_t n : lump)
            lump_[n] = is_stool ? kStool : kRefused;
        if (!is_stool)
            return;
        ++found_.lumps;
        found_.dense.insert(found_.dense.end(), lump.begin(), lump.end());
    }

    double brightest_hu(const std::vector<std::size_t>& lump) const
    {
        double hu = kPaddingHu;
        for (const std::size_t n : lump)
            hu = std::max<double>(hu, mixture_.hu(grid_.indexOf(n)));
        return hu;
    }

    bool isOpen(Index3 v, Index3 face) const
    {
        for (int steps = 1; steps <= DirectStep::kFarthest_voxels; ++steps) {
            const Index3 at = along(v, face, steps);
            const std::uint8_t label = mixture_.inside.valueOr(at, kOutside);
            if (label == kGas)
                return stepsToBright(at, {-face.i, -face.j, -face.k}) > 0;
            if (label == kFluid)
                return false;  // it reaches over a thin wall
            if (steps <= kNearAir_voxels && isAir(at))
                return true;
        }
        return false;
    }

    bool isAir(Index3 v) const { return mixture_.hu(v) < kAirInStool_hu; }

    /// The share of a lump's faces from which gas is reached without a wall.
    double openShare(const std::vector<std::size_t>& lump) const
    {
        std::size_t open = 0, all = 0;
        for (const std::size_t n : lump) {
            const Index3 v = grid_.indexOf(n);
            for (const Index3 face : kFaces) {
                const Index3 next = shifted(v, face);
                if (isBright(next))
                    continue;
                ++all;
                open += isOpen(v, face) ? 1 : 0;
            }
        }
        return all ? double(open) / double(all) : 0;
    }

    bool isStool(Index3 v) const { return grid_.contains(v) && lump_[grid_.offset(v)] == kStool; }

    /// Adds what lies between a voxel of stool and gas that it meets without a wall.
    void addStepsToGas(std::size_t stool)
    {
        const Index3 v = grid_.indexOf(stool);
        for (const Index3 d : kLines)
            for (const Index3 outward : {d, Index3{-d.i, -d.j, -d.k}})
                for (int steps = 1; steps <= DirectStep::kFarthest_voxels; ++steps) {
                    const Index3 at = along(v, outward, steps);
                    if (isStool(at))
                        break;
                    if (mixture_.inside.valueOr(at, kOutside) != kGas)
                        continue;
                    if (stepsToBright(at, {-outward.i, -outward.j, -outward.k}) == steps)
                        for (int n = 1; n < steps; ++n)
                            found_.mixed.push_back(grid_.offset(along(v, outward, n)));
                    break;
                }
    }

    /// Whether a voxel lies in a bubble or at its rim: tagging on all sides, and air near.
    bool isBubble(Index3 v) const
    {
        const auto isTagging = [&](Index3 at) {
            return isStool(at) || mixture_.inside.valueOr(at, kOutside) == kFluid;
        };
        return isEnclosed(v, isTagging) && anyInCube(v, kNearAir_voxels, [&](Index3 at) { return isAir(at); });
    }

    /// Unlabelled voxels of air near fluid.
    void addBubblesOfPools(std::vector<std::size_t>& near) const
    {
        const auto near_fluid = nearMask(mixture_.inside, kFluid, kEnclosed_voxels);
        for (std::size_t n = firstOther(near_fluid.data(), std::size_t(0), near_fluid.size(), 0); n < near_fluid.size();
             n = firstOther(near_fluid.data(), n + 1, near_fluid.size(), 0))
            if (mixture_.inside.voxels[n] == kOutside && isAir(grid_.indexOf(n)) && isBubble(grid_.indexOf(n)))
                addUnlabelledAround(n, near);
    }

    void addUnlabelledAround(std::size_t n, std::vector<std::size_t>& near) const
    {
        forEachInCube(grid_.indexOf(n), kBesideStool_voxels, [&](Index3 v) {
            if (grid_.contains(v) && mixture_.inside.at(v) == kOutside && !isStool(v))
                near.push_back(grid_.offset(v));
        });
    }

    void findMixed()
    {
        std::vector<std::size_t> near;
        for (const std::size_t n : found_.dense)
            addUnlabelledAround(n, near);
        addBubblesOfPools(near);
        for (const std::size_t n : sortedOnce(std::move(near)))
            if (isBubble(grid_.indexOf(n)))
                found_.mixed.push_back(n);
        for (const std::size_t n : found_.dense)
            addStepsToGas(n);
        found_.mixed = sortedOnce(std::move(found_.mixed));
    }

    const Mixture& mixture_;
    const Grid& grid_;
    double bright_hu_;
    DirectStep step_;
    std::size_t smallest_ = 0, largest_ = 0;
    std::vector<std::uint8_t> lump_;
    Stool found_;
};

}  // namespace

Stool findStool(const Mixture& mixture, double bright_hu, double blur_mm)
{
    return StoolFinder(mixture, bright_hu, blur_mm).run();
}

void labelStool(const Mixture& mixture, const Stool& stool, InsideVolume& labels)
{
    for (const std::size_t n : stool.dense)
        labels.voxels[n] = kFluid;
    for (const std::size_t n : stool.mixed)
        labels.voxels[n] = mixture.hu(labels.grid.indexOf(n)) < mixture.tissue_hu ? kGas : kFluid;
}

}  // namespace vicon::steps
