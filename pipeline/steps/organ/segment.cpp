#include <algorithm>
#include <cmath>
#include <optional>

#include "grid/lumen_graph.h"
#include "grid/neighbours.h"
#include "organ/cavity_seed.h"
#include "organ/tube_seed.h"
#include "segment/body.h"
#include "segment/constants.h"
#include "segment/field_of_view.h"
#include "segment/points.h"
#include "segment/region_grower.h"
#include "segment/verdict.h"
#include "vicon/steps/organ.h"
#include "vicon/steps/wall_distance.h"

namespace vicon::steps {
namespace {

// Chosen on phantoms 1 and 2 of both organs.
constexpr double kRaise_hu = 10;     // a step of the explosion control
constexpr double kBack_hu = 20;      // below the limit at which it leaked: the leak begins earlier, in small
constexpr double kLeastJump_ml = 3;  // a tube that is only just begun grows by large shares
constexpr double kRising_hu = 40;    // the density still changes towards the wall, by more than noise

/// Over a blurred edge.
int layersToWall(const Grid& grid)
{
    return std::max(1, int(kBlurredEdge_mm / grid.spacing_mm[0]));
}

/// Of outside kept around a region: it still grows over its edge.
int marginOf(const Grid& grid)
{
    return layersToWall(grid) + 1;
}

bool isBright(const OrganOptions& options)
{
    return options.densities.wall_hu < options.low_hu;
}

/// The largest component that holds one of the points; -1 when none does.
int largestAt(const RunLabels& labels, const Grid& grid, const std::vector<Point3>& points)
{
    int best = -1;
    for (const int n : componentsAt(labels, grid, points))
        if (best < 0 || labels.components[std::size_t(n)].voxels > labels.components[std::size_t(best)].voxels)
            best = n;
    return best;
}

/// The largest region up to a density that holds one of the points.
GrownRegion grownAt(RegionGrower& grower, const Grid& grid, const std::vector<Point3>& points, double low_hu,
                    double high_hu)
{
    std::vector<GrownRegion> regions;
    for (const Point3 point : points) {
        const std::optional<Index3> seed = grower.seedAt(point, kCatch_mm, low_hu, high_hu);
        if (!seed)
            continue;
        const auto holdsSeed = [&](const GrownRegion& region) {
            return region.mask.valueOr(region.mask.grid.indexAt(grid.pointAt(*seed)), kOutside) != kOutside;
        };
        if (std::none_of(regions.begin(), regions.end(), holdsSeed))
            regions.push_back(grower.grow(*seed, low_hu, high_hu, marginOf(grid)));
    }
    const auto largest = std::max_element(regions.begin(), regions.end(),
                                          [](const auto& a, const auto& b) { return a.voxels < b.voxels; });
    return largest == regions.end() ? GrownRegion{} : std::move(*largest);
}

/// The seed's region, grown as far as it does not leak.
struct Growth {
    GrownRegion region;
    double limit_hu = 0, leaked_at_hu = 0;
};

Growth grow(const HuVolume& volume, const Body& body, const OrganOptions& options, const std::vector<Point3>& seeds,
            Progress& progress)
{
    const double voxel_ml = volume.grid.voxelVolume_mm3() / 1000;
    RegionGrower grower(volume, body, RegionGrower::Padding::stops);
    const auto at = [&](double limit_hu) {
        return Growth{grownAt(grower, volume.grid, seeds, options.low_hu, limit_hu), limit_hu, 0};
    };
    const auto ml = [&](const Growth& g) { return double(g.region.voxels) * voxel_ml; };
    Growth best = at(options.high_hu);
    if (options.explosion <= 0)
        return best;
    double last_ml = ml(best), leaked_at_hu = 0;
    for (double limit_hu = options.high_hu + kRaise_hu; limit_hu <= options.growth_hu; limit_hu += kRaise_hu) {
        progress.check();
        Growth next = at(limit_hu);
        const double now_ml = ml(next);
        if (now_ml > options.largest_ml || now_ml > last_ml * (1 + options.explosion) + kLeastJump_ml) {
            leaked_at_hu = limit_hu;
            break;
        }
        last_ml = now_ml;
        best = std::move(next);
    }
    if (leaked_at_hu != 0 && best.limit_hu - kBack_hu >= options.high_hu)
        best = at(best.limit_hu - kBack_hu);
    best.leaked_at_hu = leaked_at_hu;
    return best;
}

/// Cuts passages narrower than a radius: what a ball of that radius reaches from the seeds stays, and no more.
void openNecks(InsideVolume& mask, double radius_mm, const std::vector<Point3>& seeds, Progress& progress)
{
    const double voxel_mm = mask.grid.spacing_mm[0];
    const FieldVolume wall_mm = wallDistance(mask, progress);
    const auto scan = [&](int j, int k, std::vector<VoxelRun>& runs) {
        const float* row = &wall_mm.voxels[mask.grid.offset({0, j, k})];
        const std::size_t first = runs.size();
        for (int i = 0; i < mask.grid.size[0]; ++i) {
            if (row[i] < radius_mm)
                continue;
            if (runs.size() == first || runs.back().end != i)
                runs.push_back({i, i, 0, 0});
            ++runs.back().end;
        }
    };
    const RunLabels wide = labelRuns(mask.grid.size, scan, Neighbours::faces);
    const int chosen = largestAt(wide, mask.grid, seeds);
    InsideVolume beside(mask.grid, kGas);
    wide.forEachRun([&](const VoxelRun& run, int j, int k) {
        if (int(run.label) == chosen)
            std::fill_n(&beside.at({run.begin, j, k}), run.end - run.begin, std::uint8_t(kOutside));
    });
    const FieldVolume away_mm = wallDistance(beside, progress);
    // Beyond the grid counts as outside for that distance: only what the mask holds is asked.
    for (std::size_t n = 0; n < mask.voxels.size(); ++n)
        if (mask.voxels[n] && beside.voxels[n] && away_mm.voxels[n] > radius_mm + voxel_mm)
            mask.voxels[n] = kOutside;
}

/// Over the blurred edge to the half-way density, as long as the density still changes towards the wall: where a thin
/// wall never reaches that density, the lumen ends at the wall's middle.
void growToWall(const HuVolume& volume, const OrganOptions& options, InsideVolume& mask)
{
    const double sign = isBright(options) ? -1 : 1;
    const Index3 offset = volume.grid.indexAt(mask.grid.origin_mm);
    const auto hu = [&](Index3 v) {
        return sign * volume.valueOr({v.i + offset.i, v.j + offset.j, v.k + offset.k}, kPaddingHu);
    };
    const double wall_hu = sign * options.densities.wall_hu;
    for (int layer = 0; layer < layersToWall(mask.grid); ++layer) {
        std::vector<Index3> added;
        for (std::size_t n = 0; n < mask.voxels.size(); ++n) {
            if (!mask.voxels[n])
                continue;
            const Index3 v = mask.grid.indexOf(n);
            for (const Index3 face : kFaces) {
                const Index3 to = shifted(v, face), beyond = shifted(to, face);
                if (mask.valueOr(to, kGas) == kOutside && hu(to) < wall_hu && hu(beyond) > hu(to) + kRising_hu)
                    added.push_back(to);
            }
        }
        for (const Index3 v : added)
            mask.at(v) = kGas;
    }
}

/// The ends of the organ's longest way: the root, and what lies farthest from it.
LumenPiece endsOf(const InsideVolume& mask, const OrganOptions& options, Point3 head_mm, Progress& progress)
{
    const LumenGraph graph = makeWholeGraph(wallDistance(mask, progress), 2, progress);
    const auto farthestFrom = [&](std::int32_t node) { return farthestNode(centralTree(graph, node, {}, progress)); };
    std::int32_t root = graph.nearest(head_mm);
    if (options.root == TreeRoot::far_from_feet) {
        std::int32_t lowest = 0;
        const LumenTree from_seed = centralTree(graph, root, {}, progress);
        for (std::int32_t n = 0; n < std::int32_t(graph.count()); ++n)
            if (from_seed.reaches(n) && (!from_seed.reaches(lowest) || graph.point(n).z < graph.point(lowest).z))
                lowest = n;
        root = farthestFrom(lowest);
    }
    const LumenTree tree = centralTree(graph, root, {}, progress);
    const std::int32_t tip = farthestNode(tree);
    LumenPiece piece{.rectal_end_mm = graph.point(root), .caecal_end_mm = graph.point(tip)};
    piece.length_mm = double(tree.length_mm[std::size_t(tip)]);
    piece.max_radius_mm = double(graph.node(widestNode(graph)).wall_mm);
    return piece;
}

/// A cavity has no ends: both are its widest place.
LumenPiece widestOf(const InsideVolume& mask, Progress& progress)
{
    const FieldVolume wall_mm = wallDistance(mask, progress);
    const auto widest = std::max_element(wall_mm.voxels.begin(), wall_mm.voxels.end());
    const Point3 middle = mask.grid.pointAt(mask.grid.indexOf(std::size_t(widest - wall_mm.voxels.begin())));
    LumenPiece piece{.rectal_end_mm = middle, .caecal_end_mm = middle};
    piece.max_radius_mm = double(*widest);
    return piece;
}

std::string whole(double value)
{
    return std::to_string(std::lround(value));
}

/// Where the organ's inside is grown from.
struct Seeds {
    std::vector<Point3> points_mm;
    std::string none_because;  ///< where there are no points
    std::string doubt;         ///< empty: none
};

Seeds findSeeds(const HuVolume& volume, const Body& body, const OrganOptions& options, Progress& progress)
{
    const std::string radii =
        whole(options.seed_from_radius_mm) + " to " + whole(options.seed_to_radius_mm) + " mm radius";
    if (!options.seed.empty())
        return {options.seed, {}, {}};
    if (options.hasPath())
        return {findSeedTube(volume, body, options, progress).middle_mm,
                "there is no round tube of " + radii + " and " + whole(options.seed_length_mm) +
                    " mm length near the body's midline",
                {}};
    const auto ball = findSeedBall(body, options, progress);
    if (!ball)
        return {{}, "there is no cavity of " + radii + " near the body's midline", {}};
    Seeds seeds{{ball->middle_mm}, {}, {}};
    if (ball->other_mm)
        seeds.doubt = "another cavity, at " + textOf(*ball->other_mm) +
                      " mm, is nearly as wide: name a point of the right one by organ.seed";
    return seeds;
}

/// What was grown, freed of what hangs on by narrow necks, up to the wall.
InsideVolume trimmed(InsideVolume mask, const HuVolume& volume, const OrganOptions& options,
                     const std::vector<Point3>& seeds, Progress& progress)
{
    if (options.neck_mm > 0)
        openNecks(mask, options.neck_mm, seeds, progress);
    growToWall(volume, options, mask);
    if (!options.hasPath())
        keepLargestPart(mask);
    return mask;
}

/// Verdict, notes and measures of what was found.
void judge(Segmentation& result, const LumenPiece& piece, const HuVolume& volume, const OrganOptions& options,
           const Growth& growth, const std::string& doubt)
{
    const double ml = piece.volume_ml;
    result.confidence = 1;
    result.verdict = Verdict::found;
    if (!doubt.empty()) {
        result.confidence = 0.5;
        result.verdict = Verdict::unsure;
        note(result, doubt);
    }
    if (ml > options.largest_ml) {
        result.confidence = 0.3;
        result.verdict = Verdict::unsure;
        note(result, "what was found holds " + whole(ml) + " ml: a leak");
    }
    note(result, whole(ml) + " ml, " +
                     (options.hasPath() ? "up to " + whole(piece.length_mm) + " mm from the root"
                                        : "up to " + whole(piece.max_radius_mm) + " mm from the wall"));
    if (const double cut_mm2 = lumenCut_mm2(volume, result.inside); cut_mm2 > kLargestCut_mm2)
        note(result, "the lumen goes on beyond the end of the scan, over " + whole(cut_mm2) + " mm2");
    result.measures["organ"] = options.name;
    result.measures["limit_hu"] = growth.limit_hu;
    if (growth.leaked_at_hu != 0)
        result.measures["leaked_at_hu"] = growth.leaked_at_hu;
    result.measures["volume_ml"] = ml;
}

}  // namespace

Segmentation segmentOrgan(const HuVolume& volume, const OrganOptions& options, Progress& progress)
{
    progress.report(0, "body");
    options.densities.require(false);
    const Body body = findBody(volume, progress);
    if (body.empty())
        return organAbsent("there is no body in the scan");
    progress.report(0.2, "seed");
    const auto [seeds, none_because, doubt] = findSeeds(volume, body, options, progress);
    if (seeds.empty())
        return organAbsent(none_because);
    progress.report(0.4, "lumen");
    Growth growth = grow(volume, body, options, seeds, progress);
    if (growth.region.voxels == 0)
        return organAbsent("the density at the seed is not that of the organ's inside");
    Segmentation result;
    result.inside = trimmed(std::move(growth.region.mask), volume, options, seeds, progress);
    if (std::ranges::count(result.inside.voxels, std::uint8_t(kGas)) == 0)
        return organAbsent("nothing of what was found around the seed is wider than organ.neck_mm");
    progress.report(0.8, "ends");
    const double ml = double(std::count(result.inside.voxels.begin(), result.inside.voxels.end(), kGas)) *
                      result.inside.grid.voxelVolume_mm3() / 1000;
    if (ml < options.smallest_ml)
        return organAbsent("what was found holds " + std::to_string(ml).substr(0, 4) + " ml: too little");
    LumenPiece piece =
        options.hasPath() ? endsOf(result.inside, options, seeds.front(), progress) : widestOf(result.inside, progress);
    piece.volume_ml = ml;
    result.plan.pieces = {piece};
    if (isBright(options))  // the surface then lies half-way between tissue and the contrast's own density
        std::replace(result.inside.voxels.begin(), result.inside.voxels.end(), std::uint8_t(kGas),
                     std::uint8_t(kFluid));
    judge(result, piece, volume, options, growth, doubt);
    progress.report(1, "segmented");
    return result;
}

}  // namespace vicon::steps
