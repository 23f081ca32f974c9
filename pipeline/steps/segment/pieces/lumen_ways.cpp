#include "segment/pieces/lumen_ways.h"

#include <algorithm>
#include <utility>

#include "vicon/steps/skeleton.h"

namespace vicon::steps {
namespace {

// Chosen on full-size phantoms 21 to 27 with loops that run into one another; those of long holes on 21 with voxels of
// 1.5 mm.
constexpr int kMostCuts = 8;             // of contacts, as on the centreline's path
constexpr int kTriesPerPart = 4;         // of narrow places: folds beside a hole may be narrower
constexpr double kBeside_mm = 45;        // from a hole to the middle of a tube that leads past: loops 40 mm wide
constexpr double kShortestArm_mm = 60;   // of such a tube on either side of the hole; a pouch or ileum begins there
constexpr int kMostRounds = 4;           // in which a long hole is closed
constexpr double kAside_mm = 30;         // along the path from a hole's narrowest place: beside it, not in it
constexpr double kThroughHole_mm = 100;  // from one side to the other: the way around a loop is longer

/// What a set of bars comes to.
struct Trial : LumenWays {
    NodePath nodes;  ///< of all ways, one after the other
    PathCoverage coverage;

    double length_mm() const
    {
        double sum_mm = 0;
        for (const LumenWay& way : ways)
            sum_mm += way.length_mm();
        return sum_mm;
    }
    bool isEmpty() const { return ways.empty(); }
    bool leavesNothingOut() const { return !isEmpty() && coverage.parts.empty(); }
};

/// Number of the node of a path so far along it from one of its nodes; `by` is 1 or -1.
std::size_t alongBy(const LumenGraph& graph, const NodePath& path, std::size_t at, std::ptrdiff_t by, double wanted_mm)
{
    double along_mm = 0;
    auto n = std::ptrdiff_t(at);
    for (; n + by >= 0 && n + by < std::ptrdiff_t(path.size()) && along_mm < wanted_mm; n += by)
        along_mm += distance(graph.point(path[std::size_t(n)]), graph.point(path[std::size_t(n + by)]));
    return std::size_t(n);
}

std::size_t nearestOn(const LumenGraph& graph, const NodePath& path, Point3 p)
{
    const auto isNearer = [&](std::int32_t a, std::int32_t b) {
        return distance(graph.point(a), p) < distance(graph.point(b), p);
    };
    return std::size_t(std::min_element(path.begin(), path.end(), isNearer) - path.begin());
}

/// The node of a part that is farthest along a tree, -1 where it reaches none.
std::int32_t farthestOf(const LeftOut& part, const LumenTree& tree)
{
    std::int32_t far = -1;
    for (const std::int32_t n : part.nodes)
        if (tree.reaches(n) && (far < 0 || tree.length_mm[std::size_t(n)] > tree.length_mm[std::size_t(far)]))
            far = n;
    return far;
}

/// Two parts as one, and the stretch of the path beside and between them.
LeftOut together(const LeftOut& one, const LeftOut& two)
{
    LeftOut both{one.nodes, std::min(one.from, two.from), std::max(one.to, two.to)};
    both.nodes.insert(both.nodes.end(), two.nodes.begin(), two.nodes.end());
    return both;
}

class ContactSearch {
public:
    ContactSearch(const LumenGraph& graph, Progress& progress)
        : graph_(graph), progress_(progress), widest_(widestNode(graph)), best_(seek({}))
    {
    }

    LumenWays run()
    {
        for (int cuts = 0; cuts < kMostCuts && !best_.coverage.parts.empty(); ++cuts) {
            Trial next = bestBar();
            if (next.isEmpty())
                break;
            best_ = std::move(next);
        }
        return std::move(best_);
    }

private:
    /// The longest way through what hangs together with a node.
    LumenWay wayAround(std::int32_t node, const std::vector<std::uint8_t>& barred) const
    {
        const std::int32_t end = farthestNode(centralTree(graph_, node, barred, progress_));
        LumenWay way{centralTree(graph_, end, barred, progress_), {}};
        way.nodes = way.tree.pathTo(farthestNode(way.tree));
        return way;
    }

    Trial seek(std::vector<std::uint8_t> barred) const
    {
        Trial trial;
        trial.ways.push_back(wayAround(widest_, barred));
        if (!barred.empty())
            addParted(barred, trial);
        trial.barred = std::move(barred);
        for (const LumenWay& way : trial.ways)
            trial.nodes.insert(trial.nodes.end(), way.nodes.begin(), way.nodes.end());
        trial.coverage = coverageOf(graph_, trial.nodes, options_);
        return trial;
    }

    /// The ways through what the bars part from the first one, but for specks.
    void addParted(const std::vector<std::uint8_t>& barred, Trial& trial) const
    {
        std::vector<std::uint8_t> parted(graph_.count(), 0);
        for (const LumenWay& way : best_.ways)
            for (std::size_t n = 0; n < parted.size(); ++n)
                if (way.tree.reaches(std::int32_t(n)) && !barred[n] && !trial.ways[0].tree.reaches(std::int32_t(n)))
                    parted[n] = 1;
        const auto isNarrower = [&](std::int32_t a, std::int32_t b) {
            return graph_.node(a).wall_mm < graph_.node(b).wall_mm;
        };
        for (const std::vector<std::int32_t>& set : connectedSets(graph_, std::move(parted)))
            if (double(set.size()) > options_.uncovered_fraction * double(graph_.count()))
                trial.ways.push_back(wayAround(*std::max_element(set.begin(), set.end(), isNarrower), barred));
    }

    /// The bar without which least is left out, empty where none helps. Not the first that helps: a fold on a ring of
    /// lumen opens the ring as well, but not between the loops.
    Trial bestBar() const
    {
        Trial next;
        lookOn(best_.nodes, best_.coverage, next);
        for (const LeftOut& part : best_.coverage.parts)
            for (const LumenWay& way : best_.ways)
                lookOnWaysInto(part, way, next);
        return next;
    }

    /// Looks on the ways into a part from either end of a way. Where that end is the middle of a loop, the hole lies on
    /// one of the two, though not on the way itself.
    void lookOnWaysInto(const LeftOut& part, const LumenWay& way, Trial& next) const
    {
        if (next.leavesNothingOut())
            return;
        NodePath others;
        for (const LumenWay& other : best_.ways)
            if (&other != &way)
                others.insert(others.end(), other.nodes.begin(), other.nodes.end());
        const LumenTree back = centralTree(graph_, way.nodes.back(), best_.barred, progress_);
        for (const LumenTree* tree : {&way.tree, &back}) {
            const std::int32_t far = farthestOf(part, *tree);
            if (far < 0)
                continue;
            NodePath path = tree->pathTo(far);
            path.insert(path.end(), others.begin(), others.end());
            lookOn(path, coverageOf(graph_, path, options_), next);
        }
    }

    /// Looks for contacts on a path beside each part that it leaves out, and between two of them.
    void lookOn(const NodePath& path, const PathCoverage& coverage, Trial& next) const
    {
        const std::vector<LeftOut>& parts = coverage.parts;
        for (std::size_t one = 0; one < parts.size(); ++one) {
            lookBeside(path, parts[one], next);
            for (std::size_t two = one + 1; two < parts.size(); ++two)
                lookBeside(path, together(parts[one], parts[two]), next);
        }
    }

    void lookBeside(const NodePath& path, const LeftOut& part, Trial& next) const
    {
        std::vector<Point3> tried;
        for (int n = 0; n < kTriesPerPart && !next.leavesNothingOut(); ++n) {
            const Contact contact = contactBeside(graph_, path, part, tried);
            if (contact.bars.empty())
                return;
            tried.push_back(contact.narrowest_mm);
            for (const std::vector<std::int32_t>& bar : contact.bars) {
                tryBar(contact, bar, next);
                if (const auto longer = closed(path, contact, bar); longer.size() > bar.size())
                    tryBar(contact, longer, next);
            }
        }
    }

    /// A bar with what it takes to close a longer hole: as long as the way from one side of the hole to the other is
    /// short, it leads through what is left of it.
    std::vector<std::int32_t> closed(const NodePath& path, const Contact& contact, std::vector<std::int32_t> bar) const
    {
        const std::size_t at = nearestOn(graph_, path, contact.narrowest_mm);
        const std::int32_t before = path[alongBy(graph_, path, at, -1, kAside_mm)];
        const std::int32_t after = path[alongBy(graph_, path, at, 1, kAside_mm)];
        for (int round = 0; round < kMostRounds; ++round) {
            const std::vector<std::uint8_t> barred = withBar(bar);
            const LumenTree tree = centralTree(graph_, before, barred, progress_, after);
            if (!tree.reaches(after) || double(tree.length_mm[std::size_t(after)]) > kThroughHole_mm)
                break;
            const NodePath way = tree.pathTo(after);
            const Contact rest = contactBeside(graph_, way, {{}, 0, way.size() - 1}, {});
            if (rest.bars.empty())
                break;
            bar.insert(bar.end(), rest.bars.front().begin(), rest.bars.front().end());
        }
        return bar;
    }

    std::vector<std::uint8_t> withBar(const std::vector<std::int32_t>& bar) const
    {
        std::vector<std::uint8_t> barred = best_.barred;
        barred.resize(graph_.count(), 0);
        for (const std::int32_t node : bar)
            barred[std::size_t(node)] = 1;
        return barred;
    }

    /// Takes a bar when it leaves less out than the best so far; not when the way around is no wider than the hole and
    /// no longer than through a pouch, nor when it parts what is no two loops.
    void tryBar(const Contact& contact, const std::vector<std::int32_t>& bar, Trial& next) const
    {
        std::vector<std::uint8_t> barred = withBar(bar);
        if (barred[std::size_t(widest_)])
            return;
        Trial trial = seek(std::move(barred));
        if (!contact.wider_around && trial.length_mm() - best_.length_mm() < kLongerThanPouch_mm)
            return;
        const Trial& least = next.isEmpty() ? best_ : next;
        if (trial.coverage.uncovered_fraction >= least.coverage.uncovered_fraction)
            return;
        if (trial.ways.size() > best_.ways.size() && !partsLoops(trial, contact.narrowest_mm))
            return;
        next = std::move(trial);
    }

    /// Whether every way near a hole leads past it, and at least two do.
    bool partsLoops(const Trial& trial, Point3 hole_mm) const
    {
        int past = 0;
        for (const LumenWay& way : trial.ways) {
            const std::int32_t nearest = way.nodes[nearestOn(graph_, way.nodes, hole_mm)];
            if (distance(graph_.point(nearest), hole_mm) > kBeside_mm)
                continue;
            const double arm_mm = double(way.tree.length_mm[std::size_t(nearest)]);
            if (std::min(arm_mm, way.length_mm() - arm_mm) < kShortestArm_mm)
                return false;
            ++past;
        }
        return past >= 2;
    }

    const LumenGraph& graph_;
    Progress& progress_;
    SkeletonOptions options_;  ///< so that what is left out means the same as on the centreline's path
    std::int32_t widest_;
    Trial best_;
};

}  // namespace

LumenWays findWays(const LumenGraph& graph, Progress& progress)
{
    return ContactSearch(graph, progress).run();
}

}  // namespace vicon::steps
