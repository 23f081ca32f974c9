#include "skeleton/path.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "grid/cheapest_ways.h"
#include "grid/contact.h"
#include "grid/neighbours.h"
#include "grid/voxel_lists.h"
#include "vicon/core/error.h"

namespace vicon::steps {
namespace {

// No case recorded but where one is named; the path that comes out is held by steps_skeleton_family_test. Half and
// double of each leave the three cases (CONTRIBUTING.md) as they are, but for kChunk: another way of equal cost is
// taken in ctc-prone's widest haustra, up to 13 mm aside.
constexpr double kEndTolerance_mm = 8;  // an end may lie in a block that the coarse graph leaves out
constexpr int kMostCuts = 8;            // of contacts: each costs a search of the path
constexpr int kTriesPerPart = 2;        // of such searches for a part that stays uncovered
constexpr std::size_t kChunk = 40;      // nodes of the coarse path that are refined at once

struct CoarsePath {
    NodePath nodes;
    float length_mm = 0;
    PathCoverage coverage;
    std::vector<std::uint8_t> barred;  ///< nodes of the graph that it must not use
    int cuts = 0;
};

/// What the coarse path is sought in.
struct PathSearch {
    const LumenGraph& graph;
    std::int32_t from, to;
    const SkeletonOptions& options;
    Progress& progress;
};

/// Takes the path that is left when more nodes are barred; not when that parts the ends or covers no more of the lumen,
/// nor when the way around is no wider than the hole and no longer than through a pouch.
bool tryBar(const PathSearch& search, const std::vector<std::int32_t>& bar, bool wider_around, CoarsePath& best)
{
    std::vector<std::uint8_t> barred = best.barred;
    for (const std::int32_t node : bar)
        barred[std::size_t(node)] = 1;
    const LumenTree tree = centralTree(search.graph, search.from, barred, search.progress, search.to);
    if (!tree.reaches(search.to))
        return false;
    const float length_mm = tree.length_mm[std::size_t(search.to)];
    if (!wider_around && length_mm - best.length_mm < kLongerThanPouch_mm)
        return false;
    NodePath path = tree.pathTo(search.to);
    PathCoverage coverage = coverageOf(search.graph, path, search.options);
    if (coverage.uncovered_fraction >= best.coverage.uncovered_fraction)
        return false;
    best = {std::move(path), length_mm, std::move(coverage), std::move(barred), best.cuts + 1};
    return true;
}

/// One attempt to lead the path through a part that it left aside.
bool improve(const PathSearch& search, const LeftOut& part, CoarsePath& best, std::vector<Point3>& tried)
{
    for (int n = 0; n < kTriesPerPart; ++n) {
        const Contact contact = contactBeside(search.graph, best.nodes, part, tried);
        if (contact.bars.empty())
            return false;
        tried.push_back(contact.narrowest_mm);
        for (const std::vector<std::int32_t>& bar : contact.bars)
            if (tryBar(search, bar, contact.wider_around, best))
                return true;
    }
    return false;
}

/// The central path; without nodes when the graph does not join the ends.
CoarsePath centralPath(const PathSearch& search)
{
    CoarsePath best;
    best.barred.resize(search.graph.count(), 0);
    const LumenTree whole = centralTree(search.graph, search.from, best.barred, search.progress, search.to);
    if (!whole.reaches(search.to))
        return best;
    best.nodes = whole.pathTo(search.to);
    best.length_mm = whole.length_mm[std::size_t(search.to)];
    return best;
}

/// Where the path leaves a part of the lumen aside that hangs on it in two places, it went through a contact between
/// them: another is taken. A part that hangs on it in one place is a pouch and no reason to cut.
void leadThroughWhole(const PathSearch& search, CoarsePath& best)
{
    best.coverage = coverageOf(search.graph, best.nodes, search.options);
    std::vector<Point3> tried;
    for (bool improved = true; improved && best.cuts < kMostCuts;) {
        const std::vector<LeftOut> parts = best.coverage.parts;
        improved = std::any_of(parts.begin(), parts.end(),
                               [&](const LeftOut& part) { return improve(search, part, best, tried); });
    }
}

/// Voxels in and around the blocks of a stretch of the path, as sorted offsets, in which it is refined.
std::vector<std::size_t> neighbourhoodOf(const LumenGraph& graph, const FieldVolume& wall_mm, const std::int32_t* node,
                                         const std::int32_t* end)
{
    std::vector<std::size_t> neighbourhood;
    const int reach = graph.block + graph.block / 2;
    for (; node != end; ++node)
        forEachInCube(graph.node(*node).voxel, reach, [&](Index3 v) {
            if (wall_mm.valueOr(v, 0) > 0)
                neighbourhood.push_back(graph.grid.offset(v));
        });
    return sortedOnce(std::move(neighbourhood));
}

/// The central 26-connected path between two voxels inside a neighbourhood; without `from` itself.
std::vector<Index3> refine(const FieldVolume& wall_mm, const std::vector<std::size_t>& neighbourhood, Index3 from,
                           Index3 to)
{
    const Grid& grid = wall_mm.grid;
    const auto numberOf = [&](Index3 v) {
        const auto at = std::lower_bound(neighbourhood.begin(), neighbourhood.end(), grid.offset(v));
        return at != neighbourhood.end() && *at == grid.offset(v) ? std::size_t(at - neighbourhood.begin())
                                                                  : neighbourhood.size();
    };
    const std::size_t goal = numberOf(to);
    CheapestWays<CheapestFirstWide> ways(neighbourhood.size(), numberOf(from));
    ways.run([&](std::uint32_t n, double) { return n == goal; },
             [&](std::uint32_t n, auto offer) {
                 const Index3 v = grid.indexOf(neighbourhood[n]);
                 forEachInCube(v, 1, [&](Index3 w) {
                     const std::size_t m = w != v && grid.contains(w) ? numberOf(w) : neighbourhood.size();
                     if (m == neighbourhood.size())
                         return;
                     const double ratio = 5 / double(wall_mm.at(w));
                     const Index3 by{w.i - v.i, w.j - v.j, w.k - v.k};
                     offer(m,
                           std::sqrt(double(by.i * by.i + by.j * by.j + by.k * by.k)) * ratio * ratio * ratio * ratio);
                 });
             });
    std::vector<Index3> path;
    if (!ways.reaches(goal))
        return path;
    for (const std::size_t n : ways.wayTo(goal))
        path.push_back(grid.indexOf(neighbourhood[n]));
    path.erase(path.begin());
    return path;
}

std::vector<Index3> refineAll(const FieldVolume& wall_mm, const LumenGraph& graph, const NodePath& nodes)
{
    std::vector<std::vector<Index3>> parts((nodes.size() + kChunk - 2) / kChunk);
    tbb::parallel_for(std::size_t(0), parts.size(), [&](std::size_t p) {
        const std::size_t from = p * kChunk, to = std::min(nodes.size() - 1, from + kChunk);
        const auto neighbourhood = neighbourhoodOf(graph, wall_mm, &nodes[from], &nodes[to] + 1);
        parts[p] = refine(wall_mm, neighbourhood, graph.node(nodes[from]).voxel, graph.node(nodes[to]).voxel);
    });
    std::vector<Index3> voxels{graph.node(nodes.front()).voxel};
    for (const std::vector<Index3>& part : parts) {
        if (part.empty())
            return {};
        voxels.insert(voxels.end(), part.begin(), part.end());
    }
    return voxels;
}

using TakeVoxels = std::function<void(const std::vector<Index3>&)>;

/// The path in one graph; without voxels when the graph does not join the ends.
LumenPath pathIn(const FieldVolume& wall_mm, const LumenGraph& graph, Point3 from, Point3 to,
                 const SkeletonOptions& options, Progress& progress, const TakeVoxels& take_first)
{
    const std::int32_t a = graph.nearest(from), b = graph.nearest(to);
    LumenPath path;
    if (a < 0 || distance(graph.point(a), from) > kEndTolerance_mm || distance(graph.point(b), to) > kEndTolerance_mm)
        return path;
    const PathSearch search{graph, a, b, options, progress};
    CoarsePath coarse = centralPath(search);
    if (coarse.nodes.size() < 2)
        return path;
    // Mostly the first path is the last: it is refined while another core looks at what it leaves aside.
    const NodePath first = coarse.nodes;
    tbb::parallel_invoke([&] { leadThroughWhole(search, coarse); },
                         [&] {
                             path.voxels = refineAll(wall_mm, graph, first);
                             if (!path.voxels.empty())
                                 take_first(path.voxels);
                         });
    if (coarse.nodes != first)
        path.voxels = refineAll(wall_mm, graph, coarse.nodes);
    path.uncovered_fraction = coarse.coverage.uncovered_fraction;
    path.cuts = coarse.cuts;
    return path;
}

}  // namespace

LumenPath findPath(const FieldVolume& wall_mm, const LumenGraph& coarse, Point3 from, Point3 to,
                   const SkeletonOptions& options, Progress& progress, const TakeVoxels& first)
{
    LumenPath path = pathIn(wall_mm, coarse, from, to, options, progress, first);
    for (int block = coarse.block / 2; path.voxels.empty() && block >= 1; block /= 2)
        path = pathIn(wall_mm, makeGraph(wall_mm, block, 0), from, to, options, progress, first);
    if (path.voxels.empty())
        throw Error(ErrorCode::bad_input, "the two ends of a piece of the lumen are not joined inside it", {},
                    "add the lumen between them, or drop one of them ('vicon work --help')");
    return path;
}

}  // namespace vicon::steps
