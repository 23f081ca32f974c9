#include "tissue/faint_walls.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "grid/lumen_front.h"
#include "grid/neighbours.h"
#include "grid/run_labels.h"
#include "grid/sparse_voxels.h"
#include "grid/voxels_where.h"
#include "tissue/mixture.h"
#include "vicon/core/disjoint_sets.h"

namespace vicon::steps {
namespace {

/// Up to this fraction the lumen is open. On ctc-prone .15 and .35 tell the same holes between loops, whose ridges hold
/// .44 and more; walls of faint_walls_test.cpp.
constexpr float kOpen = 0.25F;
/// On ctc-prone two loops lie 210 and 290 mm apart by way of the open lumen, the sides of a torn fold 33 mm, and what
/// is no wall at most 21: the slit beside the rectal tube, the bottoms of puddles.
constexpr float kFarApart_mm = 25;
/// Lower crests are bottoms of puddles, where the fraction is 0 in places; walls of half a millimetre have .2.
constexpr float kLeastCrest = 0.15F;
constexpr float kClosed = 0.75F;
/// Open parts of fewer blocks are recesses: what they hang on counts. 0.1 ml at the usual voxels.
constexpr std::size_t kLeastBlocks = 40;
constexpr std::uint8_t kOpenLevel = std::uint8_t(kOpen * kWhole);

/// Blocks of two voxels a side, all lumen and open.
InsideVolume openBlocks(const TissueVolume& tissue, const InsideVolume& lumen)
{
    Grid grid = lumen.grid;
    for (std::size_t a = 0; a < 3; ++a) {
        grid.size[a] /= 2;
        grid.spacing_mm[a] *= 2;
    }
    grid.origin_mm = lumen.grid.pointAt(ContinuousIndex3{0.5, 0.5, 0.5});
    InsideVolume open(grid, kOutside);
    tbb::parallel_for(0, grid.size[2], [&](int k) {
        for (int j = 0; j < grid.size[1]; ++j)
            for (int i = 0; i < grid.size[0]; ++i) {
                bool is_open = true;
                for (int corner = 0; is_open && corner < 8; ++corner) {
                    const std::size_t n =
                        lumen.grid.offset({2 * i + (corner & 1), 2 * j + (corner >> 1 & 1), 2 * k + (corner >> 2)});
                    is_open = lumen.voxels[n] != kOutside && tissue.voxels[n] <= kOpenLevel;
                }
                if (is_open)
                    open.at({i, j, k}) = kGas;
            }
    });
    return open;
}

/// How far along the open lumen: in each of its parts from its farthest end.
struct Way {
    float mm = 0;
    std::uint16_t part = LumenFront::kNoLabel;
};

class OpenLumen {
public:
    explicit OpenLumen(InsideVolume blocks) : blocks_(std::move(blocks)), front_(blocks_)
    {
        const RunLabels parts = labelLumen(blocks_, Neighbours::faces);
        std::vector<std::optional<std::size_t>> from(std::min<std::size_t>(parts.components.size(), UINT16_MAX));
        forEachRun(parts, from.size(), [&](std::size_t part, std::size_t begin, std::size_t) {
            if (!from[part] && parts.components[part].voxels >= kLeastBlocks)
                from[part] = begin;
        });
        run(from);
        forEachRun(parts, from.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
            for (std::size_t n = begin; from[part] && n < end; ++n)
                if (front_.timeAt(n) > front_.timeAt(*from[part]))
                    from[part] = n;
        });
        front_.restart();
        run(from);
    }

    /// Of a voxel of the lumen; part kNoLabel where it is not open.
    Way at(Index3 v) const
    {
        const Index3 block{v.i / 2, v.j / 2, v.k / 2};
        if (blocks_.valueOr(block, kOutside) == kOutside)
            return {};
        const std::size_t n = blocks_.grid.offset(block);
        return front_.timeAt(n) == LumenFront::kUnreached ? Way{} : Way{front_.timeAt(n), front_.labelAt(n)};
    }

private:
    /// Calls use(part, first offset, end) for each run of the first `count` parts.
    template <class Use>
    void forEachRun(const RunLabels& parts, std::size_t count, Use use) const
    {
        for (int k = 0; k < parts.size[2]; ++k)
            for (int j = 0; j < parts.size[1]; ++j)
                for (std::size_t r = parts.row_begin[parts.row(j, k)]; r < parts.row_begin[parts.row(j, k) + 1]; ++r) {
                    const VoxelRun& run = parts.runs[r];
                    const std::size_t row = blocks_.grid.offset({0, j, k});
                    if (run.label < count)
                        use(run.label, row + std::size_t(run.begin), row + std::size_t(run.end));
                }
    }

    void run(const std::vector<std::optional<std::size_t>>& from)
    {
        for (std::size_t part = 0; part < from.size(); ++part)
            if (from[part])
                front_.seed(*from[part], 0, std::uint16_t(part + 1));
        front_.run(LumenFront::Labels::adopt);
    }

    InsideVolume blocks_;
    LumenFront front_;
};

struct Crest {
    std::size_t voxel = 0;
    std::uint8_t fraction = UINT8_MAX;
};

/// What of the lumen is not open, reached from what is: the emptiest way first.
class DimLumen {
public:
    DimLumen(const TissueVolume& tissue, const InsideVolume& lumen, const OpenLumen& open)
        : tissue_(tissue),
          open_(open),
          voxels_(lumen.grid, voxelsWhere(lumen.grid, lumen.voxels, kOutside,
                                          [&](std::size_t n) {
                                              return open.at(lumen.grid.indexOf(n)).part == LumenFront::kNoLabel;
                                          })),
          reached_(voxels_.size())
    {
        for (std::size_t n = 0; n < voxels_.size(); ++n)
            forEachOverFaces(grid(), voxels_[n], [&](std::size_t beside) {
                if (const Way way = open.at(grid().indexOf(beside)); way.part != LumenFront::kNoLabel)
                    reach(n, way, 0);
            });
        for (std::size_t level = 0; level < waiting_.size(); ++level)
            for (std::size_t next = 0; next < waiting_[level].size(); ++next) {
                const std::size_t from = waiting_[level][next];
                forEachOverFaces(grid(), voxels_[from], [&](std::size_t beside) {
                    if (const std::size_t n = voxels_.numberOf(beside); n < voxels_.size())
                        reach(n, reached_[from], level);
                });
            }
    }

    /// Voxels where ways from far apart meet, and the fraction on the crest between them.
    std::vector<Crest> crests() const
    {
        std::vector<Crest> found;
        for (std::size_t n = 0; n < voxels_.size(); ++n) {
            Crest crest{voxels_[n]};
            bool meets = false;
            forEachOverFaces(grid(), voxels_[n], [&](std::size_t beside) {
                if (!isFar(reached_[n], wayAt(beside)))
                    return;
                meets = true;
                crest.fraction = std::min(crest.fraction, std::max(tissue_.voxels[voxels_[n]], tissue_.voxels[beside]));
            });
            if (meets)
                found.push_back(crest);
        }
        return found;
    }

private:
    const Grid& grid() const { return voxels_.grid(); }
    Way wayAt(std::size_t voxel) const
    {
        const std::size_t n = voxels_.numberOf(voxel);
        return n < voxels_.size() ? reached_[n] : open_.at(grid().indexOf(voxel));
    }
    static bool isFar(const Way& a, const Way& b)
    {
        return a.part != LumenFront::kNoLabel && a.part == b.part && std::abs(a.mm - b.mm) > kFarApart_mm;
    }

    /// @param level the most tissue on the way before
    void reach(std::size_t n, const Way& way, std::size_t level)
    {
        if (reached_[n].part != LumenFront::kNoLabel)
            return;
        reached_[n] = way;
        waiting_[std::max<std::size_t>(level, tissue_.voxels[voxels_[n]])].push_back(std::uint32_t(n));
    }

    const TissueVolume& tissue_;
    const OpenLumen& open_;
    SparseVoxels voxels_;
    std::vector<Way> reached_;
    std::array<std::vector<std::uint32_t>, 256> waiting_;
};

/// The sets of voxels that hang together, each two voxels thick, of which the crest is nowhere too low.
std::vector<std::vector<std::size_t>> wallsAmong(const Grid& grid, const std::vector<Crest>& crests)
{
    std::vector<std::size_t> places(crests.size());
    std::transform(crests.begin(), crests.end(), places.begin(), [](const Crest& crest) { return crest.voxel; });
    const SparseVoxels voxels(grid, std::move(places));
    DisjointSets sets(voxels.size());
    for (std::size_t n = 0; n < voxels.size(); ++n)
        voxels.forNear(voxels[n], 1, [&](std::size_t other) { sets.join(std::uint32_t(n), std::uint32_t(other)); });
    std::map<std::uint32_t, std::vector<std::size_t>> walls;  // by their root
    std::set<std::uint32_t> too_low;
    for (std::size_t n = 0; n < voxels.size(); ++n) {
        walls[sets.rootOf(std::uint32_t(n))].push_back(voxels[n]);
        if (float(crests[n].fraction) < kLeastCrest * kWhole)
            too_low.insert(sets.rootOf(std::uint32_t(n)));
    }
    std::vector<std::vector<std::size_t>> found;
    for (auto& [root, wall] : walls)
        if (!too_low.contains(root))
            found.push_back(std::move(wall));
    return found;
}

FaintWall described(const std::vector<std::size_t>& wall, const Grid& grid)
{
    Vector3 sum;
    for (const std::size_t n : wall)
        sum = sum + (grid.pointAt(grid.indexOf(n)) - Point3{});
    const double face_mm2 = std::pow(grid.voxelVolume_mm3(), 2.0 / 3);
    return {Point3{} + sum * (1 / double(wall.size())), face_mm2 * double(wall.size()) / 2};
}

}  // namespace

std::vector<FaintWall> closeFaintWalls(TissueVolume& tissue, InsideVolume& lumen)
{
    const OpenLumen open(openBlocks(tissue, lumen));
    std::vector<FaintWall> walls;
    for (const auto& wall : wallsAmong(lumen.grid, DimLumen(tissue, lumen, open).crests())) {
        for (const std::size_t n : wall) {
            lumen.voxels[n] = kOutside;
            tissue.voxels[n] = std::max(tissue.voxels[n], std::uint8_t(kClosed * kWhole));
        }
        walls.push_back(described(wall, lumen.grid));
    }
    return walls;
}

}  // namespace vicon::steps
