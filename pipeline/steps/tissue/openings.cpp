#include "tissue/openings.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <unordered_set>
#include <utility>

#include "grid/neighbours.h"
#include "grid/sparse_voxels.h"
#include "grid/thin_holes.h"
#include "grid/voxel_lists.h"
#include "grid/voxels_where.h"
#include "vicon/core/disjoint_sets.h"

namespace vicon::steps {
namespace {

// Chosen on ctc-prone, where tagged small bowel lies against descending colon and caecum, and a wedge of fluid between
// two folds was cut off.
/// What goes on without a wall for less, 0.01 ml at the usual voxels, is no opening.
constexpr std::size_t kRecess_voxels = 30;
/// The largest pocket, 1 ml at the usual voxels: more is bowel.
constexpr std::size_t kPocket_voxels = 3000;
/// The share of a pocket's surface where its own density goes on although the fraction ends: .12 and .13 of two
/// pockets, .3 and .59 of small bowel and of tagging within a fold.
constexpr double kMostOpen = 0.2;
/// Of the step from tissue to its own density: half of it is the wall.
constexpr double kGoesOn = 0.75;
/// From an opening inwards: two layers that grew, and as much again of the labels.
constexpr int kDeepest_voxels = 4;
constexpr float kShut = 0.75F;

using Voxels = std::vector<std::size_t>;

class Openings {
public:
    Openings(const Mixture& mixture, TissueVolume& tissue, InsideVolume& lumen)
        : mixture_(mixture), labels_(mixture.inside), tissue_(tissue), lumen_(lumen)
    {
    }

    /// Voxels without a wall right beyond the lumen, in order.
    Voxels beyond() const
    {
        return voxelsWhere(lumen_.grid, tissue_.voxels, std::uint8_t(kWhole),
                           [&](std::size_t n) { return isFree(n) && isBesideLumen(n); });
    }

    /// What hangs together without a wall beyond the lumen, up to more than a pocket holds; in order.
    Voxels partFrom(std::size_t first) const
    {
        std::unordered_set<std::size_t> seen{first};
        Voxels part{first};
        for (std::size_t n = 0; n < part.size() && part.size() <= kPocket_voxels; ++n)
            forEachOverFaces(lumen_.grid, part[n], [&](std::size_t beside) {
                if (isFree(beside) && seen.insert(beside).second)
                    part.push_back(beside);
            });
        std::sort(part.begin(), part.end());
        return part;
    }

    /// Whether walls surround a part.
    bool isPocket(const Voxels& part) const
    {
        if (part.size() > kPocket_voxels)
            return false;
        double sum_hu = 0;
        for (const std::size_t n : part)
            sum_hu += mixture_.hu(lumen_.grid.indexOf(n));
        const double content_hu = sum_hu / double(part.size());
        std::size_t surface = 0, open = 0;
        for (const std::size_t n : part)
            forEachOverFaces(lumen_.grid, n, [&](std::size_t beside) {
                if (lumen_.voxels[beside] != kOutside || isFree(beside))
                    return;
                const double step_hu = mixture_.hu(lumen_.grid.indexOf(beside)) - mixture_.tissue_hu;
                ++surface;
                open += step_hu / (content_hu - mixture_.tissue_hu) > kGoesOn;
            });
        return double(open) <= kMostOpen * double(surface);
    }

    /// Makes a pocket lumen.
    void fill(const Voxels& pocket)
    {
        for (const std::size_t n : pocket)
            lumen_.voxels[n] = mixture_.hu(lumen_.grid.indexOf(n)) > mixture_.tissue_hu ? kFluid : kGas;
    }

    /// Lumen that hangs in openings.
    Voxels hanging(const Voxels& beyond) const
    {
        Voxels all, front = beyond;
        for (int layer = 0; layer < kDeepest_voxels; ++layer) {
            Voxels next;
            for (const std::size_t n : front)
                forEachOverFaces(lumen_.grid, n, [&](std::size_t beside) {
                    if (hangs(beside) && !std::binary_search(all.begin(), all.end(), beside))
                        next.push_back(beside);
                });
            front = sortedOnce(std::move(next));
            const auto middle = std::ptrdiff_t(all.size());
            all.insert(all.end(), front.begin(), front.end());
            std::inplace_merge(all.begin(), all.begin() + middle, all.end());
        }
        return all;
    }

    void shut(const Voxels& voxels)
    {
        for (const std::size_t n : voxels) {
            lumen_.voxels[n] = kOutside;
            tissue_.voxels[n] = std::max(tissue_.voxels[n], std::uint8_t(kShut * kWhole));
        }
    }

    bool isBesideLumen(std::size_t n) const
    {
        bool is_beside = false;
        forEachOverFaces(lumen_.grid, n,
                         [&](std::size_t beside) { is_beside = is_beside || lumen_.voxels[beside] != kOutside; });
        return is_beside;
    }

private:
    bool isFree(std::size_t n) const { return lumen_.voxels[n] == kOutside && tissue_.voxels[n] < kHalfTissue; }

    /// Whether a voxel of the lumen is none of its labels, or lies in no cube of three voxels of the lumen.
    bool hangs(std::size_t n) const
    {
        if (lumen_.voxels[n] == kOutside)
            return false;
        if (labels_.voxels[n] == kOutside)
            return true;
        const auto isFull = [&](Index3 middle) {
            return !anyInCube(middle, 1, [&](Index3 v) { return lumen_.valueOr(v, kOutside) == kOutside; });
        };
        return !anyInCube(lumen_.grid.indexOf(n), 1, isFull);
    }

    const Mixture& mixture_;
    const InsideVolume& labels_;
    TissueVolume& tissue_;
    InsideVolume& lumen_;
};

/// What hangs together of voxels, over corners too.
std::vector<ThinHole> together(const Grid& grid, const Voxels& voxels)
{
    const SparseVoxels all(grid, voxels);
    DisjointSets sets(all.size());
    for (std::size_t n = 0; n < all.size(); ++n)
        all.forNear(all[n], 1, [&](std::size_t other) { sets.join(std::uint32_t(n), std::uint32_t(other)); });
    std::map<std::uint32_t, ThinHole> found;
    for (std::size_t n = 0; n < all.size(); ++n)
        found[sets.rootOf(std::uint32_t(n))].voxels.push_back(all[n]);
    std::vector<ThinHole> holes;
    for (auto& [root, hole] : found)
        holes.push_back(std::move(hole));
    return holes;
}

}  // namespace

std::vector<FaintWall> settleOpenings(const Mixture& mixture, const std::vector<std::size_t>& other_bowel,
                                      TissueVolume& tissue, InsideVolume& lumen)
{
    Openings openings(mixture, tissue, lumen);
    const auto isOtherBowel = [&](std::size_t n) { return std::ranges::binary_search(other_bowel, n); };
    std::unordered_set<std::size_t> settled;
    Voxels mouths;
    for (const std::size_t n : openings.beyond()) {
        if (settled.contains(n))
            continue;
        const Voxels part = openings.partFrom(n);
        settled.insert(part.begin(), part.end());
        if (part.size() <= kRecess_voxels)
            continue;
        if (std::ranges::none_of(part, isOtherBowel) && openings.isPocket(part))
            openings.fill(part);
        else
            std::ranges::copy_if(part, std::back_inserter(mouths),
                                 [&](std::size_t m) { return openings.isBesideLumen(m); });
    }
    mouths = sortedOnce(std::move(mouths));
    Voxels closed = openings.hanging(mouths);
    openings.shut(closed);
    std::ranges::copy_if(mouths, std::back_inserter(closed), [&](std::size_t n) { return openings.isBesideLumen(n); });
    closed = sortedOnce(std::move(closed));
    openings.shut(closed);
    const double face_mm2 = std::pow(lumen.grid.voxelVolume_mm3(), 2.0 / 3);
    std::vector<FaintWall> walls;
    for (const ThinHole& opening : together(lumen.grid, closed))
        if (const auto faces =
                std::ranges::count_if(opening.voxels, [&](std::size_t n) { return openings.isBesideLumen(n); }))
            walls.push_back({middleOf(opening, lumen.grid), face_mm2 * double(faces)});
    return walls;
}

}  // namespace vicon::steps
