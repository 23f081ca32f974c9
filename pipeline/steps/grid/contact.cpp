#include "grid/contact.h"

#include <algorithm>
#include <numeric>

namespace vicon::steps {
namespace {

// Chosen on the loops of loop_contacts_test.cpp and on phantoms 21 to 27 with loops that run into one another, whose
// holes are up to 10.2 mm from their middle to their rim; ctc-prone's and the shapes' pouches lie beside 14 mm and
// more.
constexpr double kWidestContact_mm = 12;
// Of the distance to the wall that the lumen has which leads around. A window of 10 mm between loops 13 mm wide needs
// 0.8; beside a fold that leaves 7 mm a pouch with mouths of 8 mm is none up to 0.87.
constexpr double kContactShare = 0.85;
constexpr double kBeyondMouth_mm = 40;  // along the path on either side: past the mouths of loops 40 mm wide
constexpr double kHoleReach_mm = 20;    // from its narrowest place: slits of 40 mm are barred in a few rounds
constexpr double kCutMargin_mm = 1.5;   // of a ball to bar, beyond the one that touches the wall
constexpr double kTriesApart_mm = 6;    // of two places that are tried

/// Which nodes are joined to some of a part's by lumen that is nowhere narrower.
std::vector<std::uint8_t> joinedTo(const LumenGraph& graph, const std::vector<std::int32_t>& part, float least_mm)
{
    std::vector<std::uint8_t> joined(graph.count(), 0);
    std::vector<std::int32_t> front;
    const auto take = [&](std::size_t n) {
        if (joined[n] || graph.nodes[n].wall_mm < least_mm)
            return;
        joined[n] = 1;
        front.push_back(std::int32_t(n));
    };
    for (const std::int32_t n : part)
        take(std::size_t(n));
    while (!front.empty()) {
        const auto n = std::size_t(front.back());
        front.pop_back();
        forEachJoined(graph.links[n], [&](std::size_t m, std::size_t) { take(m); });
    }
    return joined;
}

/// Number of the first node of the path from `at` on, in steps of `by`, that is chosen and not too far along it; the
/// path's length when there is none.
template <class IsChosen>
std::size_t firstOf(const LumenGraph& graph, const NodePath& path, std::size_t at, std::ptrdiff_t by, IsChosen isChosen)
{
    double along_mm = 0;
    for (auto n = std::ptrdiff_t(at); n >= 0 && n < std::ptrdiff_t(path.size()) && along_mm <= kBeyondMouth_mm;
         n += by) {
        if (isChosen(path[std::size_t(n)]))
            return std::size_t(n);
        if (n + by >= 0 && n + by < std::ptrdiff_t(path.size()))
            along_mm += distance(graph.point(path[std::size_t(n)]), graph.point(path[std::size_t(n + by)]));
    }
    return path.size();
}

/// The chosen nodes of the path nearest to one of its nodes on either side, by their numbers.
struct Sides {
    std::size_t before = 0, after = 0;
    bool found = false;
};

template <class IsChosen>
Sides sidesOf(const LumenGraph& graph, const NodePath& path, std::size_t at, IsChosen isChosen)
{
    const std::size_t before = firstOf(graph, path, at, -1, isChosen), after = firstOf(graph, path, at, 1, isChosen);
    return {before, after, before < path.size() && after < path.size()};
}

/// The nodes of a hole of any shape: what hangs together with its narrowest place and is narrower than the lumen around
/// it, but for the path on either side. What is wider stays open, so no loop is parted by its own bar.
std::vector<std::int32_t> holeAt(const LumenGraph& graph, const NodePath& path, std::size_t at, const Sides& sides,
                                 float least_mm)
{
    std::vector<std::uint8_t> known(graph.count(), 0);
    for (std::size_t n = 0; n < path.size(); ++n)
        known[std::size_t(path[n])] = n <= sides.before || n >= sides.after ? 1 : 0;
    const Point3 middle = graph.point(path[at]);
    std::vector<std::int32_t> hole{path[at]};
    known[std::size_t(path[at])] = 1;
    for (std::size_t n = 0; n < hole.size(); ++n)
        forEachJoined(graph.links[std::size_t(hole[n])], [&](std::size_t m, std::size_t) {
            const auto node = std::int32_t(m);
            if (known[m] || graph.node(node).wall_mm >= least_mm || distance(graph.point(node), middle) > kHoleReach_mm)
                return;
            known[m] = 1;
            hole.push_back(node);
        });
    return hole;
}

std::vector<std::int32_t> ballAbout(const LumenGraph& graph, std::int32_t middle)
{
    const double radius_mm = graph.node(middle).wall_mm + kCutMargin_mm;
    std::vector<std::int32_t> ball;
    for (std::int32_t n = 0; n < std::int32_t(graph.count()); ++n)
        if (distance(graph.point(n), graph.point(middle)) <= radius_mm)
            ball.push_back(n);
    return ball;
}

/// The contact at a node of the path; without bars when it is none.
Contact contactAtPlace(const LumenGraph& graph, const NodePath& path, std::size_t at, const LeftOut& part)
{
    Contact contact{graph.point(path[at]), {}, false};
    const auto least_mm = float(graph.node(path[at]).wall_mm / kContactShare);
    const Sides wide = sidesOf(graph, path, at, [&](std::int32_t n) { return graph.node(n).wall_mm >= least_mm; });
    if (!wide.found)
        return contact;
    const std::vector<std::uint8_t> joined = joinedTo(graph, part.nodes, least_mm);
    const Sides sides = sidesOf(graph, path, at, [&](std::int32_t n) { return joined[std::size_t(n)] != 0; });
    contact.wider_around = sides.found;
    contact.bars.push_back(holeAt(graph, path, at, sides.found ? sides : wide, least_mm));
    // A fold near by may be as narrow, and be barred with the hole.
    if (!sides.found)
        contact.bars.push_back(ballAbout(graph, path[at]));
    return contact;
}

}  // namespace

PathCoverage coverageOf(const LumenGraph& graph, const NodePath& path, const SkeletonOptions& options)
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
    PathCoverage coverage;
    coverage.uncovered_fraction = reached ? double(uncovered) / double(reached) : 0;
    for (std::vector<std::int32_t>& set : connectedSets(graph, far)) {
        if (double(set.size()) <= options.uncovered_fraction * double(reached))
            continue;
        LeftOut part{std::move(set), path.size(), 0};
        for (const std::int32_t n : part.nodes) {
            const auto foot = std::size_t(feet.foot[std::size_t(n)]);
            part.from = std::min(part.from, foot);
            part.to = std::max(part.to, foot);
        }
        coverage.parts.push_back(std::move(part));
    }
    std::stable_sort(coverage.parts.begin(), coverage.parts.end(),
                     [](const LeftOut& a, const LeftOut& b) { return a.nodes.size() > b.nodes.size(); });
    return coverage;
}

Contact contactBeside(const LumenGraph& graph, const NodePath& path, const LeftOut& part,
                      const std::vector<Point3>& tried)
{
    std::vector<std::size_t> places(part.to - part.from + 1);
    std::iota(places.begin(), places.end(), part.from);
    const auto wall_mm = [&](std::size_t n) { return graph.node(path[n]).wall_mm; };
    std::stable_sort(places.begin(), places.end(),
                     [&](std::size_t a, std::size_t b) { return wall_mm(a) < wall_mm(b); });
    std::vector<Point3> passed = tried;
    for (const std::size_t at : places) {
        if (wall_mm(at) > kWidestContact_mm)
            break;
        const Point3 here = graph.point(path[at]);
        if (std::any_of(passed.begin(), passed.end(), [&](Point3 p) { return distance(p, here) < kTriesApart_mm; }))
            continue;
        passed.push_back(here);
        Contact contact = contactAtPlace(graph, path, at, part);
        if (!contact.bars.empty())
            return contact;
    }
    return {};
}

}  // namespace vicon::steps
