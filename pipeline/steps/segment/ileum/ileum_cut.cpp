#include "segment/ileum/ileum_cut.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "grid/check_only.h"
#include "grid/lumen_graph.h"
#include "grid/neighbours.h"
#include "grid/voxel_box.h"
#include "segment/constants.h"
#include "segment/fluid/rim.h"
#include "segment/ileum/side_branch.h"
#include "segment/points.h"
#include "vicon/core/nearest_voxel.h"
#include "vicon/steps/wall_distance.h"

namespace vicon::steps {
namespace {

// Sizes of the ileocaecal valve and of gas-filled ileum: phantom seeds 1 to 8, 101, 103 and 106 with `ileum`, the prone
// scan of the reference data.
constexpr double kZone_mm = 450;      // along the voxels' faces: 260 mm or more of lumen back from the far end
constexpr double kWidestNeck_mm = 6;  // radius
constexpr double kNeckShare = 0.65;   // of the radius behind it
constexpr double kColonShare = 0.4;   // of the colon's radius before it
constexpr double kLeast_ml = 1.5, kMost_ml = 100;
constexpr double kShortest_mm = 20;
constexpr double kNarrowest_mm = 3, kWidest_mm = 12;  // radius of the ileum; an appendix is narrower
constexpr double kPouch_mm = 12;                      // from the way to the neck to the caecum's end
constexpr double kNearEnd_mm = 160;                   // a valve lies at most so far from there
constexpr double kLeastColon_ml = 50;                 // of a piece that ends in a caecum
constexpr double kTipOff_mm = 6;                      // of a tip from lumen: it may lie in the rim of fluid
// A tail behind the caecum; the prone scan of the reference data (70 mm of small bowel, 8 mm wide, behind 22 mm).
constexpr double kTailShare = 0.45, kShortestTail_mm = 30, kWideColon_mm = 15, kTailStart_mm = 15;
constexpr std::size_t kBehindNeck = 4;  // nodes of the graph
constexpr int kBlock = 2, kMostTries = 12;

bool isLumen(std::uint8_t label)
{
    return label == kGas || label == kFluid;
}

bool isLumen(const InsideVolume& labels, Index3 v)
{
    return isLumen(labels.valueOr(v, kOutside));
}

/// Whether a place is where a caecum lies: on the patient's right, in the lower half.
bool liesLowRight(Point3 p, const Body& body)
{
    const Point3 middle = interpolate(body.lower_mm, body.upper_mm, 0.5);
    return p.x < middle.x && p.z < middle.z;
}

/// The lumen around the far end, as a volume of its own.
struct Zone {
    InsideVolume mask;
    Index3 offset;   ///< of its first voxel in the lumen
    Point3 root_mm;  ///< where the colon goes on to the rectum
};

/// Voxels that lie within kZone_mm of a place, and the one of them from which the rest of the lumen hangs.
std::optional<Zone> zoneAt(const InsideVolume& inside, Point3 end_mm, Point3 start_mm, int rim_layers)
{
    const Grid& grid = inside.grid;
    const auto found = nearestVoxel(grid, end_mm, kTipOff_mm, [&](Index3 v) { return isLumen(inside, v); });
    if (!found)
        return std::nullopt;
    const Index3 seed = found->voxel;
    std::vector<bool> seen(grid.voxelCount());
    std::vector<std::size_t> front{grid.offset(seed)}, next, all;
    seen[front[0]] = true;
    const int steps = int(kZone_mm / grid.spacing_mm[0]);
    VoxelBox box;
    box.take(seed);
    for (int step = 0; step < steps && !front.empty(); ++step) {
        next.clear();
        for (const std::size_t n : front) {
            all.push_back(n);
            const Index3 v = grid.indexOf(n);
            box.take(v);
            forEachOverFaces(grid, n, [&](std::size_t beside) {
                if (isLumen(inside.voxels[beside]) && !seen[beside]) {
                    seen[beside] = true;
                    next.push_back(beside);
                }
            });
        }
        front.swap(next);
    }
    Zone zone;
    zone.root_mm = front.empty() ? start_mm : grid.pointAt(grid.indexOf(front[front.size() / 2]));
    box = box.grown(rim_layers + 2, grid);
    zone.offset = box.low;
    zone.mask = InsideVolume(cropped(grid, box));
    const auto& size = zone.mask.grid.size;
    for (const std::size_t n : all) {
        const Index3 v = grid.indexOf(n);
        zone.mask.at({v.i - zone.offset.i, v.j - zone.offset.j, v.k - zone.offset.k}) = kGas;
    }
    // The rim that the lumen will get back: without it a passage through fluid looks narrower than it is.
    tbb::parallel_for(0, size[2], [&](int k) {
        for (int j = 0; j < size[1]; ++j) {
            const std::uint8_t* from = &inside.at({zone.offset.i, j + zone.offset.j, k + zone.offset.k});
            std::uint8_t* to = &zone.mask.at({0, j, k});
            for (int i = 0; i < size[0]; ++i)
                to[i] = from[i] == kRim ? std::uint8_t(kRim) : to[i];
        }
    });
    restoreFluidRim(zone.mask, rim_layers);
    return zone;
}

bool looksLikeBowel(const LumenGraph& graph, const Neck& neck, const Branch& branch)
{
    const double node_ml = graph.grid.voxelVolume_mm3() * std::pow(graph.block, 3) / 1000;
    const double ml = node_ml * double(std::count(branch.beyond.begin(), branch.beyond.end(), 1));
    return ml >= kLeast_ml && ml <= kMost_ml && branch.length_mm >= kShortest_mm && branch.widest_mm >= kNarrowest_mm &&
           branch.widest_mm <= kWidest_mm && graph.node(neck.node).wall_mm <= kNeckShare * branch.widest_mm;
}

/// Why a branch that may be ileum is left where it is; empty when it is ileum.
std::string doubtAbout(const LumenGraph& graph, const Neck& neck, const Branch& branch, const Body& body)
{
    const double wide_mm = std::max(branch.colon_radius_mm, branch.pouch_radius_mm);
    if (graph.node(neck.node).wall_mm > kColonShare * wide_mm || branch.widest_mm > wide_mm / 1.3)
        return "the colon before it is hardly wider";
    if (branch.pouch_mm < kPouch_mm || branch.pouch_radius_mm < std::max(branch.widest_mm, wide_mm / 3))
        return "no blind end of the colon lies beside it";
    if (branch.pouch_mm > kNearEnd_mm)
        return "it lies far from the colon's end";
    if (graph.point(neck.node).x > (body.lower_mm.x + body.upper_mm.x) / 2)
        return "it lies on the patient's left";
    return {};
}

/// A place on the way through a neck, and the way's direction there.
struct CutPlane {
    Point3 at_mm;
    Vector3 outward;
    double radius_mm = 0;
};

/// The places of the way from where the passage begins, as narrow as the neck from there on, to a little behind the
/// neck.
std::vector<CutPlane> passageThrough(const LumenGraph& graph, const LumenTree& tree, const Neck& neck,
                                     const Branch& branch)
{
    const double narrow = graph.node(neck.node).wall_mm + 0.6 * graph.grid.spacing_mm[0];
    const std::vector<std::int32_t> way = tree.pathTo(branch.farthest);
    const auto at = std::size_t(std::find(way.begin(), way.end(), neck.node) - way.begin());
    std::size_t first = at;
    while (first > 0 && graph.node(way[first - 1]).wall_mm <= narrow)
        --first;
    std::vector<CutPlane> planes;
    for (std::size_t n = first; n <= at + kBehindNeck && n + 1 < way.size(); ++n) {
        const Point3 here = graph.point(way[n]), ahead = graph.point(way[std::min(n + 3, way.size() - 1)]);
        planes.push_back({here, normalized(ahead - here), double(graph.node(way[n]).wall_mm)});
    }
    return planes;
}

/// Takes out what lies behind a plane across the way to the branch, as far as it hangs together there. Returns the
/// volume, or 0 and leaves the lumen as it is where that is more than the branch or holds a place to keep.
double takeOut(InsideVolume& inside, Index3 offset, const LumenGraph& graph, const CutPlane& plane,
               const Branch& branch, const std::vector<Point3>& keep, double most_ml)
{
    const double radius = 2 * plane.radius_mm + kNeckMargin_mm;
    const double voxel_ml = inside.grid.voxelVolume_mm3() / 1000;
    const auto most = std::size_t(most_ml / voxel_ml);
    std::vector<std::pair<std::size_t, std::uint8_t>> taken;  // with the labels they had
    const auto take = [&](std::size_t n) {
        if (!isLumen(inside.voxels[n]))
            return;
        const Vector3 d = inside.grid.pointAt(inside.grid.indexOf(n)) - plane.at_mm;
        if (dot(d, plane.outward) < 0 && length(d) <= radius)
            return;  // the colon's side of the mouth
        taken.emplace_back(n, std::exchange(inside.voxels[n], std::uint8_t(kOutside)));
    };
    for (std::size_t n = 0; n < graph.count(); ++n) {
        if (branch.beyond[n])
            take(inside.grid.offset(shifted(graph.nodes[n].voxel, offset)));
    }
    for (std::size_t n = 0; n < taken.size() && taken.size() <= most; ++n)
        forEachOverFaces(inside.grid, taken[n].first, take);
    const bool wanted = std::any_of(taken.begin(), taken.end(), [&](const auto& voxel) {
        const Point3 p = inside.grid.pointAt(inside.grid.indexOf(voxel.first));
        return std::any_of(keep.begin(), keep.end(), [&](Point3 q) { return distance(p, q) < kCatch_mm; });
    });
    if (taken.size() <= most && !wanted)
        return double(taken.size()) * voxel_ml;
    for (const auto& [n, label] : taken)
        inside.voxels[n] = label;
    return 0;
}

/// Where the lumen runs on from the wide end of the colon as a narrow tube, with no bottleneck to cut: the end goes
/// back to the wide part's, and the lumen stays.
void endBeforeTail(const LumenGraph& graph, const LumenTree& tree, std::int32_t end, const Body& body, IleumCut& result)
{
    if (!tree.reaches(end) || !liesLowRight(graph.point(end), body))
        return;
    const auto along = [&](std::int32_t n) { return double(tree.length_mm[std::size_t(n)]); };
    const std::vector<std::int32_t> way = tree.pathTo(end);
    double wide_mm = 0;
    for (const std::int32_t n : way)
        wide_mm = std::max(wide_mm, double(graph.node(n).wall_mm));
    const double narrow = std::min(kWidest_mm, wide_mm * kTailShare);
    auto first = way.end();
    while (first != way.begin() && graph.node(*(first - 1)).wall_mm <= narrow)
        --first;
    if (first == way.end() || first == way.begin() || wide_mm < kWideColon_mm)
        return;
    const double tail_mm = along(end) - along(*first);
    if (tail_mm < kShortestTail_mm)
        return;
    float widest = 0;  // of the tube: what is wider than that is colon
    for (auto n = first; n != way.end(); ++n)
        widest = std::max(widest, along(*n) > along(*first) + kTailStart_mm ? graph.node(*n).wall_mm : 0);
    const std::int32_t last = *(first - 1);  // on the way itself: another end would bend the curve back
    result.moved_end_mm = graph.point(last);
    result.shorter_mm = along(end) - along(last);
    result.reason = "from " + textOf(graph.point(*first)) + " on the lumen is a tube of at most " +
                    std::to_string(std::lround(2 * widest)) +
                    " mm, ileum or appendix: it was kept, the curve ends before it";
}

/// The lumen around an end, and the ways there.
struct Surroundings {
    Index3 offset;  ///< of the graph's first voxel in the lumen
    LumenGraph graph;
    LumenTree tree;  ///< from where the colon goes on to the rectum
    std::int32_t end = -1;
};

std::optional<Surroundings> surroundingsOf(const InsideVolume& labels, Point3 end_mm, Point3 other_mm, int rim_layers,
                                           Progress& progress)
{
    const std::optional<Zone> zone = zoneAt(labels, end_mm, other_mm, rim_layers);
    if (!zone)
        return std::nullopt;
    const FieldVolume wall_mm = wallDistance(zone->mask, progress);
    Surroundings found{zone->offset, {}, {}};
    for (const int block : {kBlock, 1}) {  // 1: through a passage narrower than the blocks
        found.graph = makeGraph(wall_mm, block, 0);
        found.end = found.graph.nearest(end_mm);
        found.tree = centralTree(found.graph, found.graph.nearest(zone->root_mm), {}, progress);
        if (found.tree.reaches(found.end))
            break;
    }
    return found;
}

/// Looks for ileum at one end of a candidate.
IleumCut cutAtEnd(InsideVolume& labels, Point3 end_mm, const Surroundings& around, const std::vector<Point3>& keep,
                  const Body& body, Progress& progress)
{
    const auto& [offset, graph, tree, end] = around;
    IleumCut result;
    result.end_mm = end_mm;
    int tries = 0;
    for (const Neck& neck : necksOf(graph, tree, kWidestNeck_mm, kLeast_ml, kMost_ml)) {
        if (++tries > kMostTries)
            break;
        std::optional<Branch> branch = branchAt(graph, tree, neck);
        if (!branch || !looksLikeBowel(graph, neck, *branch))
            continue;
        const std::vector<CutPlane> planes = passageThrough(graph, tree, neck, *branch);
        if (planes.empty())
            continue;
        findColonBeside(*branch, graph, tree, neck, progress);
        result.valve_mm = planes.front().at_mm;
        result.neck_mm = graph.node(neck.node).wall_mm;
        const std::string where = " behind a passage of " + std::to_string(std::lround(2 * result.neck_mm)) +
                                  " mm at " + textOf(result.valve_mm);
        std::string doubt = doubtAbout(graph, neck, *branch, body);
        if (doubt.empty()) {
            // Where the passage opens into a fold's corner a plane right at its mouth would cut the colon too.
            for (std::size_t n = 0; n < planes.size() && result.removed_ml == 0; ++n)
                result.removed_ml = takeOut(labels, offset, graph, planes[n], *branch, keep, 1.3 * neck.behind_ml + 2);
            if (result.removed_ml == 0)
                doubt = "it comes round to the colon again, or holds an added point";
        }
        result.cut = result.removed_ml > 0;
        if (result.cut)
            result.reason = "terminal ileum" + where + " was cut off";
        else if (branch->beyond[std::size_t(end)])
            result.reason =
                std::string("the lumen").append(where).append(" may be terminal ileum and was kept: ") + doubt;
        if (result.cut)
            return result;
    }
    if (result.reason.empty())
        endBeforeTail(graph, tree, end, body, result);
    return result;
}

}  // namespace

std::vector<IleumCut> cutIlea(InsideVolume& labels, const std::vector<Candidate>& candidates, int rim_layers,
                              const std::vector<Point3>& keep, const Body& body, Progress& progress)
{
    struct End {
        Point3 at_mm, other_mm;
        std::optional<Surroundings> around;
    };
    std::vector<End> ends;
    for (const Candidate& c : candidates)
        for (const int tip : {0, 1})
            if (c.volume_ml >= kLeastColon_ml &&
                (liesLowRight(c.tip_mm[tip], body) || c.tip_radius_mm[tip] < kWidest_mm))
                ends.push_back({c.tip_mm[tip], c.tip_mm[1 - tip], {}});
    const auto look = [&](End& end) {
        CheckOnly check(progress);
        end.around = surroundingsOf(labels, end.at_mm, end.other_mm, rim_layers, check);
    };
    tbb::parallel_for(std::size_t(0), ends.size(), [&](std::size_t n) { look(ends[n]); });
    std::vector<IleumCut> found;
    bool cut = false;
    for (End& end : ends) {
        if (cut)
            look(end);  // another end's cut may have changed what lies around this one
        if (!end.around)
            continue;
        IleumCut ileum = cutAtEnd(labels, end.at_mm, *end.around, keep, body, progress);
        end.around.reset();
        cut = cut || ileum.cut;
        if (!ileum.reason.empty())
            found.push_back(std::move(ileum));
        progress.check();
    }
    return found;
}

}  // namespace vicon::steps
