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
#include "tissue/lumen_of_tissue.h"
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
/// From the point of a cut: the gap that it leaves is 3 mm wide.
constexpr double kAtCut_mm = 5;

using Voxels = std::vector<std::size_t>;
using Closed = std::map<std::size_t, ClosedWall::Voxel>;

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

    void shut(const Voxels& voxels, Closed& closed)
    {
        for (const std::size_t n : voxels)
            closed.emplace(n, closeVoxel(n, kShut, tissue_, lumen_));
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

bool isNearCut(const Voxels& voxels, const Grid& grid, const std::vector<Point3>& cuts_mm)
{
    return std::ranges::any_of(cuts_mm, [&](Point3 cut) {
        return std::ranges::any_of(
            voxels, [&](std::size_t n) { return distance(grid.pointAt(grid.indexOf(n)), cut) < kAtCut_mm; });
    });
}

/// What hangs together of closed voxels, over corners too.
std::vector<ClosedWall> together(const Grid& grid, const Closed& closed)
{
    Voxels places;
    for (const auto& [at, voxel] : closed)
        places.push_back(at);
    const SparseVoxels all(grid, places);
    DisjointSets sets(all.size());
    for (std::size_t n = 0; n < all.size(); ++n)
        all.forNear(all[n], 1, [&](std::size_t other) { sets.join(std::uint32_t(n), std::uint32_t(other)); });
    std::map<std::uint32_t, ClosedWall> found;
    for (std::size_t n = 0; n < all.size(); ++n)
        found[sets.rootOf(std::uint32_t(n))].voxels.push_back(closed.at(all[n]));
    std::vector<ClosedWall> walls;
    for (auto& [root, wall] : found)
        walls.push_back(std::move(wall));
    return walls;
}

}  // namespace

std::vector<ClosedWall> settleOpenings(const BeyondLabels& known, TissueVolume& tissue, InsideVolume& lumen)
{
    Openings openings(known.mixture, tissue, lumen);
    const auto isOtherBowel = [&](std::size_t n) { return std::ranges::binary_search(known.other_bowel, n); };
    const auto isCutOff = [&](const Voxels& voxels) { return isNearCut(voxels, lumen.grid, known.cuts_mm); };
    std::unordered_set<std::size_t> settled;
    Voxels mouths;
    for (const std::size_t n : openings.beyond()) {
        if (settled.contains(n))
            continue;
        const Voxels part = openings.partFrom(n);
        settled.insert(part.begin(), part.end());
        if (part.size() <= kRecess_voxels)
            continue;
        if (std::ranges::none_of(part, isOtherBowel) && openings.isPocket(part) &&
            !areNearTwoPieces(known.pieces, lumen.grid, part) && !isCutOff(part))
            openings.fill(part);
        else
            std::ranges::copy_if(part, std::back_inserter(mouths),
                                 [&](std::size_t m) { return openings.isBesideLumen(m); });
    }
    mouths = sortedOnce(std::move(mouths));
    Closed closed;
    openings.shut(openings.hanging(mouths), closed);
    Voxels open;
    std::ranges::copy_if(mouths, std::back_inserter(open), [&](std::size_t n) { return openings.isBesideLumen(n); });
    openings.shut(open, closed);
    const double face_mm2 = std::pow(lumen.grid.voxelVolume_mm3(), 2.0 / 3);
    std::vector<ClosedWall> walls = together(lumen.grid, closed);
    for (ClosedWall& wall : walls) {
        ThinHole hole;
        for (const ClosedWall::Voxel& voxel : wall.voxels)
            hole.voxels.push_back(voxel.at);
        const auto faces = std::ranges::count_if(hole.voxels, [&](std::size_t n) { return openings.isBesideLumen(n); });
        wall.wall = {middleOf(hole, lumen.grid), isCutOff(hole.voxels) ? 0 : face_mm2 * double(faces)};
    }
    return walls;
}

}  // namespace vicon::steps
