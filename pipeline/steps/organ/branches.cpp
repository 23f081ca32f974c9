#include "organ/branches.h"
#include "grid/cheapest_ways.h"

#include <algorithm>
#include <map>

namespace vicon::steps {
namespace {

// Chosen on phantoms 1 and 2 of both organs.
constexpr float kCover = 1.5F;        // of the local radius: what lies nearer to a path belongs to its tube
constexpr float kRootEnd_mm = 20;     // the tube's width at the root is that of this stretch
constexpr double kLeastLength = 0.8;  // of its radius: a shorter stretch between two forks is one fork

/// Calls use(neighbour, length_mm) for every node joined to `n`.
template <class Use>
void forEachNeighbour(const LumenGraph& graph, std::int32_t n, Use use)
{
    forEachJoined(graph.links[std::size_t(n)], [&](std::size_t m, std::size_t) {
        use(std::int32_t(m), float(distance(graph.point(n), graph.point(std::int32_t(m)))));
    });
}

/// Marks what belongs to the tube around a path: within kCover radii of it, inside the lumen.
/// @param least_mm at least so far around each
void cover(const LumenGraph& graph, const std::vector<std::int32_t>& path, std::vector<float>& left_mm,
           float least_mm = 0)
{
    CheapestFirstWide queue;  // of what is left, below 0: the most left first
    const auto voxel_mm = float(graph.grid.spacing_mm[0]);
    const auto offer = [&](std::int32_t n, float mm) {
        if (mm > left_mm[std::size_t(n)]) {
            left_mm[std::size_t(n)] = mm;
            queue.push(-double(mm), std::uint32_t(n));
        }
    };
    for (const std::int32_t n : path)
        offer(n, std::max(least_mm, kCover * graph.node(n).wall_mm + voxel_mm));
    const auto known = [&](std::uint32_t n) { return -double(left_mm[n]); };
    runFront(queue, known, [&](std::uint32_t n, double cost) {
        const auto left = float(-cost);
        forEachNeighbour(graph, std::int32_t(n), [&](std::int32_t m, float apart_mm) {
            if (left > apart_mm)
                offer(m, left - apart_mm);
        });
        return true;
    });
}

/// How far a tip reaches beyond the tubes at its fork: beyond the ball to the wall of every path node that holds the
/// fork. Where the scan's end cuts a tube, the fork's own ball is small, and its neighbours' tell the tube's width.
double reachBeyond(const LumenGraph& graph, const std::vector<std::int32_t>& paths, std::int32_t fork, std::int32_t tip)
{
    const Point3 at = graph.point(fork), end = graph.point(tip);
    double least_mm = distance(at, end) - double(graph.node(fork).wall_mm);
    for (const std::int32_t n : paths) {
        const auto wall_mm = double(graph.node(n).wall_mm);
        const Point3 p = graph.point(n);
        if (distance(p, at) <= wall_mm + graph.grid.spacing_mm[0])
            least_mm = std::min(least_mm, distance(p, end) - wall_mm);
    }
    return least_mm;
}

/// The ways from the root to the tips, as a tree of nodes.
struct Ways {
    std::vector<std::uint8_t> on;
    std::vector<std::int32_t> parent;  ///< of nodes on a way; -1: the root
    std::vector<float> length_mm;      ///< from the root
};

/// Finds ways from tips; keeps its memory between them.
class WayFinder {
public:
    explicit WayFinder(const LumenGraph& graph)
        : graph_(graph), cost_(graph.count(), kUnreached), from_(graph.count(), -1)
    {
    }

    /// The cheapest way from a node that is on a way already to a tip, both included. Ways from the root alone would
    /// run beside each other down a wide tube.
    std::vector<std::int32_t> find(const Ways& ways, std::int32_t tip)
    {
        for (const std::int32_t n : touched_)
            cost_[std::size_t(n)] = kUnreached;
        touched_.clear();
        queue_.clear();
        reach(tip, 0, -1);
        std::int32_t met = tip;
        const auto known = [&](std::uint32_t n) { return cost_[n]; };
        runFront(queue_, known, [&](std::uint32_t number, float so_far) {
            const auto n = std::int32_t(number);
            if (ways.on[number]) {
                met = n;
                return false;
            }
            const float own = centralCost(graph_.node(n).wall_mm);
            forEachNeighbour(graph_, n, [&](std::int32_t m, float apart_mm) {
                reach(m, so_far + apart_mm * 0.5F * (own + centralCost(graph_.node(m).wall_mm)), n);
            });
            return true;
        });
        return wayTo(met);
    }

private:
    static constexpr float kUnreached = 1e30F;  // above any cost

    void reach(std::int32_t n, float cost, std::int32_t from)
    {
        float& known = cost_[std::size_t(n)];
        if (cost >= known)
            return;
        if (known == kUnreached)
            touched_.push_back(n);
        known = cost;
        from_[std::size_t(n)] = from;
        queue_.push(cost, std::uint32_t(n));
    }
    /// From the tip to the node, in that order.
    std::vector<std::int32_t> wayTo(std::int32_t n) const
    {
        std::vector<std::int32_t> way;
        for (; n >= 0; n = from_[std::size_t(n)])
            way.push_back(n);
        std::reverse(way.begin(), way.end());
        return way;
    }

    const LumenGraph& graph_;
    std::vector<float> cost_;
    std::vector<std::int32_t> from_, touched_;
    CheapestFirst queue_;
};

/// Covers the root's end of the tube: where the end of the scan cuts it, the rim of the cut is no tip.
void coverRoot(const LumenGraph& graph, const Ways& ways, const std::vector<std::int32_t>& first,
               std::vector<float>& covered)
{
    float radius_mm = 0;
    for (const std::int32_t n : first)
        if (ways.length_mm[std::size_t(n)] < kRootEnd_mm)
            radius_mm = std::max(radius_mm, graph.node(n).wall_mm);
    cover(graph, {first.back()}, covered, 2 * radius_mm);
}

Ways waysToTips(const LumenGraph& graph, const LumenTree& tree, double branch_mm, Progress& progress)
{
    Ways ways{std::vector<std::uint8_t>(graph.count(), 0), std::vector<std::int32_t>(graph.count(), -1),
              std::vector<float>(graph.count(), 0)};
    std::vector<float> covered(graph.count(), 0);
    ways.on[std::size_t(tree.root)] = 1;
    std::vector<std::int32_t> order;
    for (std::int32_t n = 0; n < std::int32_t(graph.count()); ++n)
        if (tree.reaches(n))
            order.push_back(n);
    std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
        return tree.length_mm[std::size_t(a)] > tree.length_mm[std::size_t(b)];
    });
    std::vector<std::int32_t> paths;
    WayFinder finder(graph);
    for (const std::int32_t tip : order) {
        if (covered[std::size_t(tip)] > 0)
            continue;
        progress.check();
        const std::vector<std::int32_t> way = finder.find(ways, tip);
        if (!paths.empty() && reachBeyond(graph, paths, way.back(), tip) < branch_mm) {
            cover(graph, {tip}, covered);
            continue;
        }
        for (std::size_t n = way.size() - 1; n-- > 0;) {
            const auto at = std::size_t(way[n]), before = std::size_t(way[n + 1]);
            ways.on[at] = 1;
            ways.parent[at] = way[n + 1];
            ways.length_mm[at] = ways.length_mm[before] + float(distance(graph.point(way[n]), graph.point(way[n + 1])));
        }
        if (paths.empty())
            coverRoot(graph, ways, way, covered);
        paths.insert(paths.end(), way.begin(), way.end());
        cover(graph, way, covered);
    }
    return ways;
}

/// Makes branches of the nodes, the one that leads farthest first.
class Builder {
public:
    Builder(const LumenGraph& graph, const Ways& ways, std::int32_t root)
        : graph_(graph), ways_(ways), root_(root), farthest_(graph.count(), 0)
    {
        std::vector<std::int32_t> nodes;
        for (std::int32_t n = 0; n < std::int32_t(ways.on.size()); ++n)
            if (ways.on[std::size_t(n)])
                nodes.push_back(n);
        std::stable_sort(nodes.begin(), nodes.end(), [&](std::int32_t a, std::int32_t b) {
            return ways.length_mm[std::size_t(a)] > ways.length_mm[std::size_t(b)];
        });
        for (const std::int32_t n : nodes) {  // children before parents
            auto& far = farthest_[std::size_t(n)];
            far = std::max(far, ways.length_mm[std::size_t(n)]);
            const std::int32_t parent = ways.parent[std::size_t(n)];
            if (parent < 0)
                continue;
            children_[parent].push_back(n);
            farthest_[std::size_t(parent)] = std::max(farthest_[std::size_t(parent)], far);
        }
        for (auto& [node, list] : children_)
            std::stable_sort(list.begin(), list.end(), [&](std::int32_t a, std::int32_t b) {
                return farthest_[std::size_t(a)] > farthest_[std::size_t(b)];
            });
    }

    std::vector<NodeBranch> build()
    {
        add(-1, 0, {root_});
        return std::move(branches_);
    }

private:
    /// Adds the branch that begins with these nodes, and what follows it.
    void add(int parent, int generation, std::vector<std::int32_t> nodes)
    {
        while (children_[nodes.back()].size() == 1)
            nodes.push_back(children_[nodes.back()].front());
        const std::vector<std::int32_t> next = children_[nodes.back()];
        const double length_mm =
            double(ways_.length_mm[std::size_t(nodes.back())] - ways_.length_mm[std::size_t(nodes.front())]);
        if (parent >= 0 && !next.empty() && length_mm < kLeastLength * double(graph_.node(nodes.back()).wall_mm)) {
            for (const std::int32_t child : next) {  // one fork with its parent's
                std::vector<std::int32_t> longer = nodes;
                longer.push_back(child);
                add(parent, generation, std::move(longer));
            }
            return;
        }
        const int own = int(branches_.size());
        branches_.push_back({parent, generation, nodes});
        for (const std::int32_t child : next)
            add(own, generation + 1, {nodes.back(), child});
    }

    const LumenGraph& graph_;
    const Ways& ways_;
    std::int32_t root_;
    std::vector<float> farthest_;
    std::map<std::int32_t, std::vector<std::int32_t>> children_;
    std::vector<NodeBranch> branches_;
};

}  // namespace

std::vector<NodeBranch> branchesOf(const LumenGraph& graph, const LumenTree& tree, double branch_mm, Progress& progress)
{
    const Ways ways = waysToTips(graph, tree, branch_mm, progress);
    return Builder(graph, ways, tree.root).build();
}

}  // namespace vicon::steps
