#include "grid/lumen_graph.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace vicon::steps {
namespace {

// No case recorded. Half of it leaves the three cases (CONTRIBUTING.md) as they are.
constexpr double kWhole = 0.97;  // of the blocks: the rest are specks in corners of the wall

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

/// Node in each block, or -1; with a rim of empty blocks around.
struct BlockMap {
    std::array<std::ptrdiff_t, 3> size;
    std::vector<std::int32_t> node;

    std::ptrdiff_t at(int i, int j, int k) const { return i + 1 + size[0] * (j + 1 + size[1] * (k + 1)); }
};

/// Which of the 27 blocks around a node's hold a node, and which of those are joined to it.
class Joiner {
public:
    Joiner(const LumenGraph& graph, const FieldVolume& wall_mm, const BlockMap& blocks)
        : graph_(graph), wall_mm_(wall_mm), blocks_(blocks)
    {
    }
    LumenGraph::Links linksOf(std::size_t n) const
    {
        LumenGraph::Links links;
        const LumenGraph::Node& own = graph_.nodes[n];
        const int i = own.voxel.i / graph_.block, j = own.voxel.j / graph_.block, k = own.voxel.k / graph_.block;
        for (int row = 0; row < 9; ++row) {
            const std::int32_t* three = &blocks_.node[std::size_t(blocks_.at(i - 1, j + row % 3 - 1, k + row / 3 - 1))];
            for (int which = 3 * row; which < 3 * row + 3; ++which, ++three) {
                if (*three < 0)
                    continue;
                if ((links.there >> 3 * row & 7) == 0)
                    links.first[std::size_t(row)] = std::uint32_t(*three);
                links.there |= 1U << which;
                if (std::size_t(*three) != n && joined(n, std::size_t(*three)))
                    links.joined |= 1U << which;
            }
        }
        return links;
    }

private:
    bool joined(std::size_t n, std::size_t m) const
    {
        const LumenGraph::Node &own = graph_.nodes[n], &other = graph_.nodes[m];
        const auto& spacing_mm = graph_.grid.spacing_mm;
        const double x = (own.voxel.i - other.voxel.i) * spacing_mm[0];
        const double y = (own.voxel.j - other.voxel.j) * spacing_mm[1];
        const double z = (own.voxel.k - other.voxel.k) * spacing_mm[2];
        const double overlap = double(own.wall_mm) + double(other.wall_mm);
        if (graph_.block == 1 || x * x + y * y + z * z < overlap * overlap)
            return true;
        // The smaller node first, so that both ends of an edge see the same line.
        return n < m ? lineInside(wall_mm_, own.voxel, other.voxel) : lineInside(wall_mm_, other.voxel, own.voxel);
    }

    const LumenGraph& graph_;
    const FieldVolume& wall_mm_;
    const BlockMap& blocks_;
};

void joinNodes(LumenGraph& graph, const FieldVolume& wall_mm, const BlockMap& blocks)
{
    const Joiner joiner(graph, wall_mm, blocks);
    graph.links.resize(graph.count());
    const auto chunk = std::size_t(4096);
    tbb::parallel_for(std::size_t(0), graph.count() / chunk + 1, [&](std::size_t c) {
        for (std::size_t n = c * chunk; n < std::min(graph.count(), (c + 1) * chunk); ++n)
            graph.links[n] = joiner.linksOf(n);
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
    BlockMap map{{blocks[0] + 2, blocks[1] + 2, blocks[2] + 2}, {}};
    map.node.assign(std::size_t(map.size[0] * map.size[1] * map.size[2]), -1);
    std::size_t b = 0;
    for (int k = 0; k < blocks[2]; ++k)
        for (int j = 0; j < blocks[1]; ++j)
            for (int i = 0; i < blocks[0]; ++i, ++b) {
                if (best[b] == kNone)
                    continue;
                map.node[std::size_t(map.at(i, j, k))] = std::int32_t(graph.nodes.size());
                graph.nodes.push_back({graph.grid.indexOf(best[b]), wall_mm.voxels[best[b]]});
            }
    joinNodes(graph, wall_mm, map);
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

}  // namespace vicon::steps
