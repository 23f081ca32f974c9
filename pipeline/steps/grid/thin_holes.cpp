#include "grid/thin_holes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <utility>

#include "grid/cube_opening.h"
#include "grid/neighbours.h"
#include "grid/run_labels.h"
#include "grid/sparse_voxels.h"
#include "grid/voxels_where.h"
#include "vicon/core/disjoint_sets.h"

namespace vicon::steps {
namespace {

// On ctc-prone with fractions of .15 to .25, 3.5 to 5 mm and 3 to 8 voxels the same walls between loops and torn folds
// are closed, give or take two specks and a side hole of the rectal tube; with .25 walls of half a millimetre
// (tissue_faint_walls_test.cpp) are open. On ten phantom scans, one of them with low dose and one with stool, none is.
/// Up to this fraction the lumen is open.
constexpr float kOpen = 0.2F;
/// Sides that are not joined within a cube of this half width, which holds where their ways begin, are those of a wall.
constexpr double kNear_mm = 4;
/// So far behind a crest a thin wall's lumen is open: what is longer is a narrow passage.
constexpr std::uint8_t kThin_voxels = 5;
/// Lower crests are bottoms of puddles, where the fraction is 0 in places; walls of half a millimetre have .2.
constexpr float kLeastCrest = 0.15F;
constexpr std::uint8_t kOpenLevel = std::uint8_t(kOpen * UINT8_MAX);

/// The lumen where cubes of two voxels a side are open, and its connected parts.
class OpenLumen {
public:
    OpenLumen(const Volume<std::uint8_t>& fraction, const InsideVolume& lumen) : open_(lumen.grid, kOutside)
    {
        const auto slice = std::ptrdiff_t(lumen.grid.size[0]) * lumen.grid.size[1];
        tbb::parallel_for(0, lumen.grid.size[2], [&](int k) {
            const auto from = lumen.voxels.begin() + slice * k;
            std::transform(from, from + slice, fraction.voxels.begin() + slice * k, open_.voxels.begin() + slice * k,
                           [](std::uint8_t label, std::uint8_t share) {
                               return std::uint8_t(label != kOutside && share <= kOpenLevel ? kGas : kOutside);
                           });
        });
        openByCubes(open_);
        parts_ = labelLumen(open_, Neighbours::faces);
        for (int axis = 0; axis < 3; ++axis)
            reach_[std::size_t(axis)] =
                std::max(kThin_voxels + 1, int(std::lround(kNear_mm / lumen.grid.spacing_mm[std::size_t(axis)])));
    }

    const Grid& grid() const { return open_.grid; }
    bool has(std::size_t voxel) const { return open_.voxels[voxel] != kOutside; }

    /// Whether two of its voxels hang together near `middle`.
    bool areNear(std::size_t a, std::size_t b, std::size_t middle) const
    {
        return joinedAlongAxes(a, b) || joinedNear(a, b, middle);
    }

    bool inOnePart(std::size_t a, std::size_t b) const
    {
        return parts_.labelAt(grid().indexOf(a)) == parts_.labelAt(grid().indexOf(b));
    }

private:
    /// Whether an open way leads from one voxel to another along one axis after the other: so do nearly all.
    bool joinedAlongAxes(std::size_t from, std::size_t to) const
    {
        const Index3 a = grid().indexOf(from);
        const Index3 b = grid().indexOf(to);
        const std::array<int, 3> steps{b.i - a.i, b.j - a.j, b.k - a.k};
        const std::array<std::size_t, 3> stride{1, grid().offset({0, 1, 0}), grid().offset({0, 0, 1})};
        const auto leads = [&](const std::array<std::size_t, 3>& axes) {
            std::size_t at = from;
            for (const std::size_t axis : axes)
                for (int n = 0; n < std::abs(steps[axis]); ++n) {
                    at += steps[axis] > 0 ? stride[axis] : 0 - stride[axis];
                    if (!has(at))
                        return false;
                }
            return true;
        };
        return leads({0, 1, 2}) || leads({0, 2, 1}) || leads({1, 0, 2}) || leads({1, 2, 0}) || leads({2, 0, 1}) ||
               leads({2, 1, 0});
    }

    /// Whether a way leads from one voxel to another through voxels near `middle`.
    bool joinedNear(std::size_t from, std::size_t to, std::size_t middle) const
    {
        const Index3 centre = grid().indexOf(middle);
        const auto numberOf = [&](std::size_t voxel) {
            const Index3 v = grid().indexOf(voxel);
            const std::array<int, 3> at{v.i - centre.i + reach_[0], v.j - centre.j + reach_[1],
                                        v.k - centre.k + reach_[2]};
            for (std::size_t a = 0; a < 3; ++a)
                if (at[a] < 0 || at[a] > 2 * reach_[a])
                    return -1;
            return at[0] + (2 * reach_[0] + 1) * (at[1] + (2 * reach_[1] + 1) * at[2]);
        };
        std::vector<char> taken(std::size_t((2 * reach_[0] + 1) * (2 * reach_[1] + 1) * (2 * reach_[2] + 1)), 0);
        bool joined = false;
        floodOverFaces(grid(), {from}, [&](std::size_t voxel) {
            joined = joined || voxel == to;
            const int n = joined || !has(voxel) ? -1 : numberOf(voxel);
            return n >= 0 && std::exchange(taken[std::size_t(n)], char(1)) == 0;
        });
        return joined;
    }

    InsideVolume open_;
    RunLabels parts_;
    std::array<int, 3> reach_{};
};

struct Crest {
    std::size_t voxel = 0;
    std::uint8_t fraction = UINT8_MAX;
    bool only_way = false;
};

/// What of the lumen is not open, reached from what is: the emptiest way first.
class DimLumen {
public:
    DimLumen(const Volume<std::uint8_t>& fraction, const InsideVolume& lumen, const OpenLumen& open)
        : fraction_(fraction),
          open_(open),
          voxels_(lumen.grid,
                  voxelsWhere(lumen.grid, lumen.voxels, kOutside, [&](std::size_t n) { return !open.has(n); })),
          reached_(voxels_.size())
    {
        for (std::size_t n = 0; n < voxels_.size(); ++n)
            forEachOverFaces(voxels_.grid(), voxels_[n], [&](std::size_t beside) {
                if (open.has(beside))
                    reach(n, {beside, 1}, 0);
            });
        for (std::size_t level = 0; level < waiting_.size(); ++level)
            for (std::size_t next = 0; next < waiting_[level].size(); ++next) {
                const Way& from = reached_[waiting_[level][next]];
                const Way way{from.open, std::uint8_t(std::min(from.steps + 1, UINT8_MAX))};
                forEachOverFaces(voxels_.grid(), voxels_[waiting_[level][next]], [&](std::size_t beside) {
                    if (const std::size_t n = voxels_.numberOf(beside); n < voxels_.size())
                        reach(n, way, level);
                });
            }
    }

    /// Voxels where ways from both sides of a wall meet, and the fraction on the crest between them.
    std::vector<Crest> crests() const
    {
        std::vector<Crest> all(voxels_.size());
        tbb::parallel_for(std::size_t(0), voxels_.size(), [&](std::size_t n) {
            all[n].voxel = kNone;
            forEachOverFaces(voxels_.grid(), voxels_[n], [&](std::size_t beside) {
                const Way way = wayAt(beside);
                if (!isAcross(reached_[n], way, voxels_[n]))
                    return;
                all[n].only_way = all[n].only_way || !open_.inOnePart(reached_[n].open, way.open);
                all[n].voxel = voxels_[n];
                all[n].fraction =
                    std::min(all[n].fraction, std::max(fraction_.voxels[voxels_[n]], fraction_.voxels[beside]));
            });
        });
        std::erase_if(all, [](const Crest& crest) { return crest.voxel == kNone; });
        return all;
    }

private:
    static constexpr std::size_t kNone = SIZE_MAX;  // no voxel

    struct Way {
        std::size_t open = kNone;  ///< the open voxel that it begins at
        std::uint8_t steps = 0;
    };

    Way wayAt(std::size_t voxel) const
    {
        const std::size_t n = voxels_.numberOf(voxel);
        return n < voxels_.size() ? reached_[n] : open_.has(voxel) ? Way{voxel, 0} : Way{};
    }

    bool isAcross(const Way& a, const Way& b, std::size_t between) const
    {
        return a.open != kNone && b.open != kNone && a.open != b.open && std::max(a.steps, b.steps) <= kThin_voxels &&
               !open_.areNear(a.open, b.open, between);
    }

    /// @param level the most tissue on the way before
    void reach(std::size_t n, const Way& way, std::size_t level)
    {
        if (reached_[n].open != kNone)
            return;
        reached_[n] = way;
        waiting_[std::max<std::size_t>(level, fraction_.voxels[voxels_[n]])].push_back(std::uint32_t(n));
    }

    const Volume<std::uint8_t>& fraction_;
    const OpenLumen& open_;
    SparseVoxels voxels_;
    std::vector<Way> reached_;
    std::array<std::vector<std::uint32_t>, 256> waiting_;
};

}  // namespace

std::vector<ThinHole> findThinHoles(const Volume<std::uint8_t>& fraction, const InsideVolume& lumen)
{
    const OpenLumen open(fraction, lumen);
    const std::vector<Crest> crests = DimLumen(fraction, lumen, open).crests();
    std::vector<std::size_t> places(crests.size());
    std::transform(crests.begin(), crests.end(), places.begin(), [](const Crest& crest) { return crest.voxel; });
    const SparseVoxels voxels(lumen.grid, std::move(places));
    DisjointSets sets(voxels.size());
    for (std::size_t n = 0; n < voxels.size(); ++n)
        voxels.forNear(voxels[n], 1, [&](std::size_t other) { sets.join(std::uint32_t(n), std::uint32_t(other)); });
    std::map<std::uint32_t, ThinHole> holes;  // by their root
    std::set<std::uint32_t> too_low;
    for (std::size_t n = 0; n < voxels.size(); ++n) {
        const std::uint32_t root = sets.rootOf(std::uint32_t(n));
        holes[root].voxels.push_back(voxels[n]);
        holes[root].only_way = holes[root].only_way || crests[n].only_way;
        if (float(crests[n].fraction) < kLeastCrest * UINT8_MAX)
            too_low.insert(root);
    }
    std::vector<ThinHole> found;
    for (auto& [root, hole] : holes)
        if (!too_low.contains(root))
            found.push_back(std::move(hole));
    return found;
}

Point3 middleOf(const ThinHole& hole, const Grid& grid)
{
    Vector3 sum;
    for (const std::size_t n : hole.voxels)
        sum = sum + (grid.pointAt(grid.indexOf(n)) - Point3{});
    return Point3{} + sum * (1 / double(hole.voxels.size()));
}

}  // namespace vicon::steps
