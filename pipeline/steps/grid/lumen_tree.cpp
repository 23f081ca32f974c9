#include "grid/lumen_graph.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid/cheapest_first.h"

namespace vicon::steps {
namespace {

constexpr double kReference_mm = 5;  // only scales the cost
constexpr float kInfinite = std::numeric_limits<float>::infinity();

/// Where a node lies in its block. What a front looks at most often is kept by itself, in the fewest bytes: the looks
/// go all over the lumen, and each is a cache line that is not there.
struct Place {
    std::array<std::uint8_t, 3> in_block{};  ///< of the node's voxel
};

/// Calls use(neighbour, which) for every node joined to the one with these links, `which` of the 27 blocks around.
template <class Use>
void forEachJoined(const LumenGraph::Links& links, Use use)
{
    for (std::size_t row = 0; row < links.first.size(); ++row) {
        const std::uint32_t there = links.there >> 3 * row, joined = links.joined >> 3 * row;
        std::size_t n = links.first[row];
        for (std::size_t i = 0; i < 3; ++i) {
            if (joined >> i & 1)
                use(n, 3 * row + i);
            n += there >> i & 1;
        }
    }
}

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

float weight(float wall_mm)
{
    const float ratio = float(kReference_mm) / std::max(0.1F, wall_mm);
    return ratio * ratio * ratio * ratio;
}

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
        sites[n] = {EdgeLengths::placeOf(graph, n), weight(graph.nodes[n].wall_mm)};
    std::vector<Way> ways(sites.size());
    LumenTree tree{root, {}, std::vector<float>(sites.size(), kInfinite), {}};
    const EdgeLengths lengths(graph);
    CheapestFirst queue;
    tree.cost[std::size_t(root)] = 0;
    queue.push(0, std::uint32_t(root));
    for (std::size_t count = 0; !queue.empty(); ++count) {
        if (count % 65536 == 0)
            progress.check();
        const auto [cost, node] = queue.pop();
        if (cost > tree.cost[node])
            continue;
        if (std::int32_t(node) == goal)
            break;
        fetchAhead(graph, queue, tree.cost, sites);
        const Site own = sites[node];
        const float length_mm = ways[node].length_mm;
        forEachJoined(graph.links[node], [&, so_far = cost, n = node](std::size_t m, std::size_t which) {
            float& known = tree.cost[m];
            if (known <= so_far)
                return;
            const Site& other = sites[m];
            const float apart = lengths.of(which, own, other);
            const float to = so_far + apart * 0.5F * (own.weight + other.weight);
            if (to < known && (blocked.empty() || !blocked[m])) {
                known = to;
                ways[m] = {std::int32_t(n), length_mm + apart};
                queue.push(to, std::uint32_t(m));
            }
        });
    }
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
    while (!queue.empty()) {
        const auto [so_far, node] = queue.pop();
        if (so_far > feet.distance_mm[node])
            continue;
        fetchAhead(graph, queue, feet.distance_mm, sites);
        const Place own = sites[node];
        const std::int32_t foot = feet.foot[node];
        forEachJoined(graph.links[node], [&, here = so_far](std::size_t m, std::size_t which) {
            float& known = feet.distance_mm[m];
            if (known <= here)
                return;
            const float to = here + lengths.of(which, own, sites[m]);
            if (to < known) {
                known = to;
                feet.foot[m] = foot;
                queue.push(to, std::uint32_t(m));
            }
        });
    }
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
