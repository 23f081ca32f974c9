#include "skeleton_tree.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "cheapest_first.h"

namespace vicon::steps {
namespace {

constexpr double kReference_mm = 5;  // only scales the cost
constexpr double kWhole = 0.97;      // of the blocks: the rest are specks in corners of the wall
constexpr float kInfinite = std::numeric_limits<float>::infinity();

/// What a front has to know of a node it may step to lies together: each such look is a cache line that is not there.
struct Place {
    std::array<std::uint8_t, 3> in_block{};  ///< of the node's voxel
};

/// Calls use(neighbour, direction) for every node joined to `n`.
template <class Use>
void forEachJoined(const LumenGraph& graph, std::int32_t n, Use use)
{
    const LumenGraph::Node& own = graph.node(n);
    const std::int32_t* here = &graph.node_of[own.cell];
    for (std::uint32_t bits = own.joined; bits; bits &= bits - 1) {
        const auto direction = std::size_t(std::countr_zero(bits));
        use(std::size_t(here[graph.neighbour[direction]]), direction);
    }
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
                    if (i || j || k)
                        step_[n++] = {i * graph.block, j * graph.block, k * graph.block};
    }
    static Place placeOf(const LumenGraph& graph, std::size_t n)
    {
        const Index3 v = graph.nodes[n].voxel;
        return {{std::uint8_t(v.i % graph.block), std::uint8_t(v.j % graph.block), std::uint8_t(v.k % graph.block)}};
    }
    float of(std::size_t direction, const Place& from, const Place& to) const
    {
        std::array<float, 3> apart;
        for (std::size_t d = 0; d < 3; ++d)
            apart[d] = float(step_[direction][d] + to.in_block[d] - from.in_block[d]) * spacing_[d];
        return std::sqrt(apart[0] * apart[0] + apart[1] * apart[1] + apart[2] * apart[2]);
    }

private:
    std::array<float, 3> spacing_{};
    std::array<std::array<int, 3>, 26> step_{};  ///< voxels between two blocks, in the order of LumenGraph::neighbour
};

float weight(float wall_mm)
{
    const float ratio = float(kReference_mm) / std::max(0.1F, wall_mm);
    return ratio * ratio * ratio * ratio;
}

/// Offset in `wall_mm` of each block's voxel farthest from the wall, kNone where the block is left out.
constexpr auto kNone = ~std::uint32_t(0);
std::vector<std::uint32_t> farthestOfBlocks(const FieldVolume& wall_mm, int block, double least_mm,
                                            const std::array<int, 3>& blocks)
{
    const auto& size = wall_mm.grid.size;
    const auto sx = std::size_t(blocks[0]), sy = std::size_t(blocks[1]);
    std::vector<std::uint32_t> best(sx * sy * std::size_t(blocks[2]), kNone);
    tbb::parallel_for(0, blocks[2], [&](int bk) {
        for (int k = bk * block; k < std::min(size[2], (bk + 1) * block); ++k)
            for (int j = 0; j < size[1]; ++j) {
                const std::size_t row = wall_mm.grid.offset({0, j, k});
                std::uint32_t* out = &best[sx * (std::size_t(j / block) + sy * std::size_t(bk))];
                for (int i = 0; i < size[0]; ++i) {
                    const float d = wall_mm.voxels[row + std::size_t(i)];
                    if (d <= 0 || d < least_mm)
                        continue;
                    std::uint32_t& own = out[i / block];
                    if (own == kNone || wall_mm.voxels[own] < d)
                        own = std::uint32_t(row) + std::uint32_t(i);
                }
            }
    });
    return best;
}

/// Whether every voxel of the digital line between two voxels is inside.
bool lineInside(const FieldVolume& wall_mm, Index3 a, Index3 b)
{
    const int steps = std::max({std::abs(b.i - a.i), std::abs(b.j - a.j), std::abs(b.k - a.k)});
    for (int n = 1; n < steps; ++n) {
        const auto at = [&](int from, int to) { return from + int(std::floor(double(to - from) * n / steps + 0.5)); };
        if (wall_mm.at({at(a.i, b.i), at(a.j, b.j), at(a.k, b.k)}) <= 0)
            return false;
    }
    return true;
}

void joinNodes(LumenGraph& graph, const FieldVolume& wall_mm)
{
    const auto chunk = std::size_t(4096);
    tbb::parallel_for(std::size_t(0), graph.count() / chunk + 1, [&](std::size_t c) {
        for (std::size_t n = c * chunk; n < std::min(graph.count(), (c + 1) * chunk); ++n) {
            LumenGraph::Node& own = graph.nodes[n];
            for (std::size_t d = 0; d < graph.neighbour.size(); ++d) {
                const std::int32_t m = graph.node_of[std::size_t(std::ptrdiff_t(own.cell) + graph.neighbour[d])];
                if (m < 0)
                    continue;
                const LumenGraph::Node& other = graph.node(m);
                const double apart = distance(graph.grid.pointAt(own.voxel), graph.grid.pointAt(other.voxel));
                // The smaller voxel first, so that both ends of an edge see the same line.
                const bool first = n < std::size_t(m);
                if (graph.block == 1 || apart < own.wall_mm + other.wall_mm ||
                    lineInside(wall_mm, first ? own.voxel : other.voxel, first ? other.voxel : own.voxel))
                    own.joined |= 1U << d;
            }
        }
    });
}

}  // namespace

std::int32_t LumenGraph::nearest(Point3 p) const
{
    std::int32_t best = -1;
    double least = 1e300;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        const double d = distance(point(std::int32_t(n)), p);
        if (d < least) {
            least = d;
            best = std::int32_t(n);
        }
    }
    return best;
}

LumenGraph makeGraph(const FieldVolume& wall_mm, int block, double least_mm)
{
    LumenGraph graph;
    graph.grid = wall_mm.grid;
    graph.block = block;
    std::array<int, 3> blocks{};
    for (std::size_t a = 0; a < 3; ++a)
        blocks[a] = (wall_mm.grid.size[a] + block - 1) / block;
    const std::vector<std::uint32_t> best = farthestOfBlocks(wall_mm, block, least_mm, blocks);
    const auto nx = std::ptrdiff_t(blocks[0]) + 2, ny = std::ptrdiff_t(blocks[1]) + 2,
               nz = std::ptrdiff_t(blocks[2]) + 2;
    graph.node_of.assign(std::size_t(nx * ny * nz), -1);
    std::size_t b = 0;
    for (int k = 0; k < blocks[2]; ++k)
        for (int j = 0; j < blocks[1]; ++j)
            for (int i = 0; i < blocks[0]; ++i, ++b) {
                if (best[b] == kNone)
                    continue;
                const auto cell = std::uint32_t(i + 1 + nx * (j + 1 + ny * (k + 1)));
                graph.node_of[cell] = std::int32_t(graph.nodes.size());
                graph.nodes.push_back({graph.grid.indexOf(best[b]), cell, wall_mm.voxels[best[b]], 0});
            }
    std::size_t n = 0;
    for (int k = -1; k <= 1; ++k)
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i)
                if (i || j || k)
                    graph.neighbour[n++] = i + nx * (j + ny * k);
    joinNodes(graph, wall_mm);
    return graph;
}

std::int32_t widestNode(const LumenGraph& graph)
{
    const auto widest = std::max_element(graph.nodes.begin(), graph.nodes.end(),
                                         [](const auto& a, const auto& b) { return a.wall_mm < b.wall_mm; });
    return widest == graph.nodes.end() ? -1 : std::int32_t(widest - graph.nodes.begin());
}

LumenGraph makeWholeGraph(const FieldVolume& wall_mm, int coarsest, Progress& progress)
{
    LumenGraph graph;
    for (int block = coarsest; block >= 1; block /= 2) {
        graph = makeGraph(wall_mm, block, 0);
        progress.check();
        if (block == 1 || graph.count() == 0)
            break;
        const auto sets = connectedSets(graph, std::vector<std::uint8_t>(graph.count(), 1));
        const std::int32_t widest = widestNode(graph);
        const bool whole = std::any_of(sets.begin(), sets.end(), [&](const std::vector<std::int32_t>& set) {
            return double(set.size()) > kWhole * double(graph.count()) &&
                   std::find(set.begin(), set.end(), widest) != set.end();
        });
        if (whole)
            break;
    }
    return graph;
}

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
        float cost = kInfinite, weight = 0, length_mm = 0;
        std::int32_t parent = -1;
    };
    std::vector<Site> sites(graph.count());
    for (std::size_t n = 0; n < sites.size(); ++n) {
        static_cast<Place&>(sites[n]) = EdgeLengths::placeOf(graph, n);
        sites[n].weight = weight(graph.nodes[n].wall_mm);
    }
    const EdgeLengths lengths(graph);
    CheapestFirst queue;
    sites[std::size_t(root)].cost = 0;
    queue.push(0, std::uint32_t(root));
    for (std::size_t count = 0; !queue.empty(); ++count) {
        if (count % 65536 == 0)
            progress.check();
        const auto [cost, node] = queue.pop();
        const Site own = sites[node];
        if (cost > own.cost)
            continue;
        if (std::int32_t(node) == goal)
            break;
        forEachJoined(graph, std::int32_t(node), [&, so_far = cost, n = node](std::size_t m, std::size_t direction) {
            Site& other = sites[m];
            if (other.cost <= so_far)
                return;
            const float apart = lengths.of(direction, own, other);
            const float to = so_far + apart * 0.5F * (own.weight + other.weight);
            if (to < other.cost && (blocked.empty() || !blocked[m])) {
                other.cost = to;
                other.parent = std::int32_t(n);
                other.length_mm = own.length_mm + apart;
                queue.push(to, std::uint32_t(m));
            }
        });
    }
    LumenTree tree{root, std::vector<std::int32_t>(sites.size()), std::vector<float>(sites.size()),
                   std::vector<float>(sites.size())};
    for (std::size_t n = 0; n < sites.size(); ++n) {
        tree.parent[n] = sites[n].parent;
        tree.cost[n] = sites[n].cost;
        tree.length_mm[n] = sites[n].length_mm;
    }
    return tree;
}

LumenFeet feetOn(const LumenGraph& graph, const std::vector<std::int32_t>& sources)
{
    struct Site : Place {
        float distance_mm = kInfinite;
        std::int32_t foot = -1;
    };
    std::vector<Site> sites(graph.count());
    for (std::size_t n = 0; n < sites.size(); ++n)
        static_cast<Place&>(sites[n]) = EdgeLengths::placeOf(graph, n);
    const EdgeLengths lengths(graph);
    CheapestFirst queue;
    for (std::size_t s = 0; s < sources.size(); ++s) {
        sites[std::size_t(sources[s])].distance_mm = 0;
        sites[std::size_t(sources[s])].foot = std::int32_t(s);
        queue.push(0, std::uint32_t(sources[s]));
    }
    while (!queue.empty()) {
        const auto [so_far, node] = queue.pop();
        const Site own = sites[node];
        if (so_far > own.distance_mm)
            continue;
        forEachJoined(graph, std::int32_t(node), [&, here = so_far](std::size_t m, std::size_t direction) {
            Site& other = sites[m];
            if (other.distance_mm <= here)
                return;
            const float to = here + lengths.of(direction, own, other);
            if (to < other.distance_mm) {
                other.distance_mm = to;
                other.foot = own.foot;
                queue.push(to, std::uint32_t(m));
            }
        });
    }
    LumenFeet feet{std::vector<float>(sites.size()), std::vector<std::int32_t>(sites.size())};
    for (std::size_t n = 0; n < sites.size(); ++n) {
        feet.distance_mm[n] = sites[n].distance_mm;
        feet.foot[n] = sites[n].foot;
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
            forEachJoined(graph, set[n], [&](std::size_t other, std::size_t) {
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
