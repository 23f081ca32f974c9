#include "skeleton/path.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "grid/cheapest_ways.h"
#include "grid/neighbours.h"
#include "vicon/core/error.h"

namespace vicon::steps {
namespace {

// No case recorded but where one is named; the path that comes out is held by steps_skeleton_family_test. Half and
// double of each leave the three cases (CONTRIBUTING.md) as they are, but for kChunk: another way of equal cost is
// taken in ctc-prone's widest haustra, up to 13 mm aside.
constexpr double kEndTolerance_mm = 8;  // an end may lie in a block that the coarse graph leaves out
constexpr double kCutMargin_mm = 1.5;   // what is removed at a contact, beyond its own radius
constexpr int kMostCuts = 8;            // of contacts: each costs a search of the path
constexpr int kTriesPerPart = 2;        // of such searches for a part that stays uncovered
// A contact is narrow beside the lumen around it; the prone reference scan's widest pouches lie beside 13 of 25 mm.
constexpr double kWidestContact_mm = 8;
constexpr double kContactShare = 0.5;
constexpr double kEndZone_mm = 15;  // the path is narrow at its tips; that is no contact
constexpr std::size_t kChunk = 40;  // nodes of the coarse path that are refined at once

using NodePath = std::vector<std::int32_t>;

/// A part of the lumen far from the path, and the stretch of the path beside which it lies.
struct Uncovered {
    std::size_t nodes = 0;
    std::size_t from = 0;  ///< numbers of the first and the last node of the path that it hangs on
    std::size_t to = 0;
};

struct Coverage {
    double fraction = 0;           ///< of the reached nodes, in all that is uncovered
    std::vector<Uncovered> parts;  ///< largest first
};

Coverage coverageOf(const LumenGraph& graph, const NodePath& path, const SkeletonOptions& options)
{
    const LumenFeet feet = feetOn(graph, path);
    std::vector<std::uint8_t> far(graph.count(), 0);
    std::size_t reached = 0, uncovered = 0;
    for (std::size_t n = 0; n < graph.count(); ++n)
        if (feet.foot[n] >= 0) {
            ++reached;
            far[n] = feet.distance_mm[n] > options.uncovered_mm ? 1 : 0;
            uncovered += far[n];
        }
    Coverage coverage;
    coverage.fraction = reached ? double(uncovered) / double(reached) : 0;
    for (const auto& set : connectedSets(graph, far)) {
        Uncovered part{set.size(), path.size(), 0};
        for (const std::int32_t n : set) {
            const auto foot = std::size_t(feet.foot[std::size_t(n)]);
            part.from = std::min(part.from, foot);
            part.to = std::max(part.to, foot);
        }
        if (double(part.nodes) > options.uncovered_fraction * double(reached))
            coverage.parts.push_back(part);
    }
    std::stable_sort(coverage.parts.begin(), coverage.parts.end(),
                     [](const Uncovered& a, const Uncovered& b) { return a.nodes > b.nodes; });
    return coverage;
}

/// The narrowest node of a stretch of the path that lies away from the path's ends and has not been tried, if it is
/// narrow enough for a contact; -1 otherwise.
std::int32_t narrowest(const LumenGraph& graph, const NodePath& path, const Uncovered& beside,
                       const std::vector<Point3>& tried)
{
    std::int32_t best = -1;
    float widest = 0;
    const Point3 first = graph.point(path.front()), last = graph.point(path.back());
    for (std::size_t n = beside.from; n <= beside.to; ++n) {
        const Point3 p = graph.point(path[n]);
        if (distance(p, first) < kEndZone_mm || distance(p, last) < kEndZone_mm)
            continue;
        const bool known = std::any_of(tried.begin(), tried.end(), [&](Point3 q) { return distance(p, q) < 6; });
        widest = std::max(widest, graph.node(path[n]).wall_mm);
        if (!known && (best < 0 || graph.node(path[n]).wall_mm < graph.node(best).wall_mm))
            best = path[n];
    }
    if (best >= 0 && graph.node(best).wall_mm > std::min(kWidestContact_mm, kContactShare * widest))
        return -1;
    return best;
}

void block(const LumenGraph& graph, std::int32_t centre, std::vector<std::uint8_t>& blocked)
{
    const Point3 p = graph.point(centre);
    const double radius = graph.node(centre).wall_mm + kCutMargin_mm;
    for (std::size_t n = 0; n < graph.count(); ++n)
        if (distance(graph.point(std::int32_t(n)), p) <= radius)
            blocked[n] = 1;
}

struct CoarsePath {
    NodePath nodes;
    Coverage coverage;
    int cuts = 0;
};

/// Where the way is barred, and the places at which that was tried.
struct Bars {
    std::vector<std::uint8_t> blocked;
    std::vector<Point3> tried;
};

/// One attempt to lead the path through a part that it left aside. A cut that parts the two ends, or that covers no
/// more of the lumen, is taken back.
bool improve(const LumenGraph& graph, std::int32_t from, std::int32_t to, const Uncovered& part, CoarsePath& best,
             Bars& bars, const SkeletonOptions& options, Progress& progress)
{
    for (int n = 0; n < kTriesPerPart; ++n) {
        const std::int32_t narrow = narrowest(graph, best.nodes, part, bars.tried);
        if (narrow < 0)
            return false;
        bars.tried.push_back(graph.point(narrow));
        std::vector<std::uint8_t> with_cut = bars.blocked;
        block(graph, narrow, with_cut);
        const LumenTree tree = centralTree(graph, from, with_cut, progress, to);
        if (!tree.reaches(to))
            continue;
        NodePath path = tree.pathTo(to);
        Coverage coverage = coverageOf(graph, path, options);
        if (coverage.fraction >= best.coverage.fraction)
            continue;
        best = {std::move(path), std::move(coverage), best.cuts + 1};
        bars.blocked = std::move(with_cut);
        return true;
    }
    return false;
}

/// The central path; where it leaves a part of the lumen aside that hangs on it in two places, it went through a
/// contact between them. A part that hangs on it in one place is a pouch and no reason to cut.
CoarsePath coarsePath(const LumenGraph& graph, std::int32_t from, std::int32_t to, const SkeletonOptions& options,
                      Progress& progress)
{
    Bars bars{std::vector<std::uint8_t>(graph.count(), 0), {}};
    CoarsePath best;
    const LumenTree whole = centralTree(graph, from, bars.blocked, progress, to);
    if (!whole.reaches(to))
        return best;
    best.nodes = whole.pathTo(to);
    best.coverage = coverageOf(graph, best.nodes, options);
    for (bool improved = true; improved && best.cuts < kMostCuts;) {
        improved = false;
        for (const Uncovered& part : std::vector<Uncovered>(best.coverage.parts))
            if (!improved)
                improved = improve(graph, from, to, part, best, bars, options, progress);
    }
    return best;
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
    std::sort(neighbourhood.begin(), neighbourhood.end());
    neighbourhood.erase(std::unique(neighbourhood.begin(), neighbourhood.end()), neighbourhood.end());
    return neighbourhood;
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

/// The path in one graph; without voxels when the graph does not join the ends.
LumenPath pathIn(const FieldVolume& wall_mm, const LumenGraph& graph, Point3 from, Point3 to,
                 const SkeletonOptions& options, Progress& progress)
{
    const std::int32_t a = graph.nearest(from), b = graph.nearest(to);
    LumenPath path;
    if (a < 0 || distance(graph.point(a), from) > kEndTolerance_mm || distance(graph.point(b), to) > kEndTolerance_mm)
        return path;
    const CoarsePath coarse = coarsePath(graph, a, b, options, progress);
    if (coarse.nodes.size() < 2)
        return path;
    return {refineAll(wall_mm, graph, coarse.nodes), coarse.coverage.fraction, coarse.cuts};
}

}  // namespace

LumenPath findPath(const FieldVolume& wall_mm, const LumenGraph& coarse, Point3 from, Point3 to,
                   const SkeletonOptions& options, Progress& progress)
{
    LumenPath path = pathIn(wall_mm, coarse, from, to, options, progress);
    for (int block = coarse.block / 2; path.voxels.empty() && block >= 1; block /= 2)
        path = pathIn(wall_mm, makeGraph(wall_mm, block, 0), from, to, options, progress);
    if (path.voxels.empty())
        throw Error(ErrorCode::bad_input, "the two ends of a piece of the lumen are not joined inside it", {},
                    "segment the scan again");
    return path;
}

}  // namespace vicon::steps
