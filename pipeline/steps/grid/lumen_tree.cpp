#include "grid/lumen_graph.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid/cheapest_ways.h"

namespace vicon::steps {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();  // no way is known yet

/// Where a node lies in its block. What a front looks at most often is kept by itself, in the fewest bytes: the looks
/// go all over the lumen, and each is a cache line that is not there.
struct Place {
    std::array<std::uint8_t, 3> in_block{};  ///< of the node's voxel
};

/// Asks for the memory that is looked at when the nodes come out of the queue that wait at its head: they lie anywhere
/// in the lumen, so nothing of them is in a cache.
template <class Site>
void fetchAhead(const LumenGraph& graph, const CheapestFirst& queue, const std::vector<float>& reached,
                const std::vector<Site>& sites)
{
    if (queue.empty())
        return;
    for (const std::uint32_t first : graph.links[queue.next()].first) {
        __builtin_prefetch(&reached[first]);
        __builtin_prefetch(&sites[first]);
    }
    queue.forEachBehindNext([&](std::uint32_t n) {
        __builtin_prefetch(&graph.links[n]);
        __builtin_prefetch(&graph.links[n].joined);
    });
}

/// Lengths of the graph's edges, mm.
class EdgeLengths {
public:
    explicit EdgeLengths(const LumenGraph& graph)
    {
        for (std::size_t d = 0; d < 3; ++d)
            spacing_[d] = float(graph.grid.spacing_mm[d]);
        std::size_t n = 0;
        for (int k = -1; k <= 1; ++k)
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i)
                    step_[n++] = {i * graph.block, j * graph.block, k * graph.block};
    }
    static Place placeOf(const LumenGraph& graph, std::size_t n)
    {
        const Index3 v = graph.nodes[n].voxel;
        return {{std::uint8_t(v.i % graph.block), std::uint8_t(v.j % graph.block), std::uint8_t(v.k % graph.block)}};
    }
    float of(std::size_t which, const Place& from, const Place& to) const
    {
        std::array<float, 3> apart;
        for (std::size_t d = 0; d < 3; ++d)
            apart[d] = float(step_[which][d] + to.in_block[d] - from.in_block[d]) * spacing_[d];
        return std::sqrt(apart[0] * apart[0] + apart[1] * apart[1] + apart[2] * apart[2]);
    }

private:
    std::array<float, 3> spacing_{};
    std::array<std::array<int, 3>, 27> step_{};  ///< voxels from a block to those around
};

}  // namespace

std::vector<std::int32_t> LumenTree::pathTo(std::int32_t node) const
{
    std::vector<std::int32_t> path;
    for (; node >= 0; node = parent[std::size_t(node)])
        path.push_back(node);
    std::reverse(path.begin(), path.end());
    return path;
}

LumenTree centralTree(const LumenGraph& graph, std::int32_t root, const std::vector<std::uint8_t>& blocked,
                      Progress& progress, std::int32_t goal)
{
    struct Site : Place {
        float weight = 0;
    };
    struct Way {
        std::int32_t parent = -1;
        float length_mm = 0;
    };
    std::vector<Site> sites(graph.count());
    for (std::size_t n = 0; n < sites.size(); ++n)
        sites[n] = {EdgeLengths::placeOf(graph, n), centralCost(graph.nodes[n].wall_mm)};
    std::vector<Way> ways(sites.size());
    LumenTree tree{root, {}, std::vector<float>(sites.size(), kInfinite), {}};
    const EdgeLengths lengths(graph);
    CheapestFirst queue;
    tree.cost[std::size_t(root)] = 0;
    queue.push(0, std::uint32_t(root));
    std::size_t count = 0;
    const auto known = [&](std::uint32_t n) { return tree.cost[n]; };
    // Not CheapestWays: what is looked at most often lies in arrays of its own here, fetched ahead.
    runFront(queue, known, [&](std::uint32_t node, float so_far) {
        if (count++ % 65536 == 0)
            progress.check();
        if (std::int32_t(node) == goal)
            return false;
        fetchAhead(graph, queue, tree.cost, sites);
        const Site own = sites[node];
        const float length_mm = ways[node].length_mm;
        forEachJoined(graph.links[node], [&](std::size_t m, std::size_t which) {
            float& cost = tree.cost[m];
            if (cost <= so_far)
                return;
            const Site& other = sites[m];
            const float apart = lengths.of(which, own, other);
            const float to = so_far + apart * 0.5F * (own.weight + other.weight);
            if (to < cost && (blocked.empty() || !blocked[m])) {
                cost = to;
                ways[m] = {std::int32_t(node), length_mm + apart};
                queue.push(to, std::uint32_t(m));
            }
        });
        return true;
    });
    tree.parent.reserve(ways.size());
    tree.length_mm.reserve(ways.size());
    for (const Way& way : ways) {
        tree.parent.push_back(way.parent);
        tree.length_mm.push_back(way.length_mm);
    }
    return tree;
}

LumenFeet feetOn(const LumenGraph& graph, const std::vector<std::int32_t>& sources)
{
    std::vector<Place> sites(graph.count());
    for (std::size_t n = 0; n < sites.size(); ++n)
        sites[n] = EdgeLengths::placeOf(graph, n);
    LumenFeet feet{std::vector<float>(sites.size(), kInfinite), std::vector<std::int32_t>(sites.size(), -1)};
    const EdgeLengths lengths(graph);
    CheapestFirst queue;
    for (std::size_t s = 0; s < sources.size(); ++s) {
        feet.distance_mm[std::size_t(sources[s])] = 0;
        feet.foot[std::size_t(sources[s])] = std::int32_t(s);
        queue.push(0, std::uint32_t(sources[s]));
    }
    const auto known = [&](std::uint32_t n) { return feet.distance_mm[n]; };
    runFront(queue, known, [&](std::uint32_t node, float so_far) {
        fetchAhead(graph, queue, feet.distance_mm, sites);
        const Place own = sites[node];
        const std::int32_t foot = feet.foot[node];
        forEachJoined(graph.links[node], [&](std::size_t m, std::size_t which) {
            float& distance_mm = feet.distance_mm[m];
            if (distance_mm <= so_far)
                return;
            const float to = so_far + lengths.of(which, own, sites[m]);
            if (to < distance_mm) {
                distance_mm = to;
                feet.foot[m] = foot;
                queue.push(to, std::uint32_t(m));
            }
        });
        return true;
    });
    return feet;
}

std::vector<std::vector<std::int32_t>> connectedSets(const LumenGraph& graph, std::vector<std::uint8_t> chosen)
{
    std::vector<std::vector<std::int32_t>> sets;
    for (std::size_t first = 0; first < chosen.size(); ++first) {
        if (!chosen[first])
            continue;
        chosen[first] = 0;
        std::vector<std::int32_t> set{std::int32_t(first)};
        for (std::size_t n = 0; n < set.size(); ++n)
            forEachJoined(graph.links[std::size_t(set[n])], [&](std::size_t other, std::size_t) {
                if (chosen[other]) {
                    chosen[other] = 0;
                    set.push_back(std::int32_t(other));
                }
            });
        sets.push_back(std::move(set));
    }
    return sets;
}

std::int32_t farthestNode(const LumenTree& tree)
{
    std::int32_t best = tree.root;
    for (std::size_t n = 0; n < tree.parent.size(); ++n)
        if (tree.parent[n] >= 0 && tree.length_mm[n] > tree.length_mm[std::size_t(best)])
            best = std::int32_t(n);
    return best;
}

}  // namespace vicon::steps
