#include "segment/ileum/side_branch.h"
#include "segment/constants.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vicon::steps {
namespace {

/// 1 for nodes in a ball that closes a neck: wide enough that no edge of the graph leaps over it.
std::vector<std::uint8_t> closedAt(const LumenGraph& graph, const Neck& neck)
{
    const Point3 centre = graph.point(neck.node);
    const double radius =
        graph.node(neck.node).wall_mm + kNeckMargin_mm + 0.87 * graph.block * graph.grid.spacing_mm[0];
    std::vector<std::uint8_t> closed(graph.count(), 0);
    for (std::size_t n = 0; n < graph.count(); ++n)
        closed[n] = distance(graph.point(std::int32_t(n)), centre) <= radius ? 1 : 0;
    return closed;
}

}  // namespace

std::vector<Neck> necksOf(const LumenGraph& graph, const LumenTree& tree, double widest_mm, double least_ml,
                          double most_ml)
{
    const double node_ml = graph.grid.voxelVolume_mm3() * std::pow(graph.block, 3) / 1000;
    std::vector<std::int32_t> order(graph.count());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
        const float ca = tree.cost[std::size_t(a)], cb = tree.cost[std::size_t(b)];
        return ca != cb ? ca > cb : a > b;
    });
    std::vector<float> behind(graph.count(), float(node_ml));
    std::vector<std::int32_t> heaviest(graph.count(), -1);
    for (const std::int32_t n : order) {
        const std::int32_t parent = tree.parent[std::size_t(n)];
        if (parent < 0)
            continue;
        behind[std::size_t(parent)] += behind[std::size_t(n)];
        std::int32_t& heavy = heaviest[std::size_t(parent)];
        if (heavy < 0 || behind[std::size_t(n)] > behind[std::size_t(heavy)])
            heavy = n;
    }
    std::vector<Neck> necks;
    for (const std::int32_t n : order) {
        const std::int32_t parent = tree.parent[std::size_t(n)], heavy = heaviest[std::size_t(n)];
        const float own = graph.node(n).wall_mm;
        if (parent < 0 || heavy < 0 || own > widest_mm || behind[std::size_t(n)] < least_ml ||
            behind[std::size_t(n)] > most_ml)
            continue;
        if (graph.node(parent).wall_mm >= own && graph.node(heavy).wall_mm > own)
            necks.push_back({n, behind[std::size_t(n)]});
    }
    std::stable_sort(necks.begin(), necks.end(),
                     [](const Neck& a, const Neck& b) { return a.behind_ml > b.behind_ml; });
    return necks;
}

std::optional<Branch> branchAt(const LumenGraph& graph, const LumenTree& tree, const Neck& neck)
{
    std::vector<std::uint8_t> open = closedAt(graph, neck);
    if (open[std::size_t(tree.root)])
        return std::nullopt;
    for (std::size_t n = 0; n < open.size(); ++n)
        open[n] = open[n] || !tree.reaches(std::int32_t(n)) ? 0 : 1;
    Branch branch;
    branch.beyond.assign(graph.count(), 0);
    for (const std::vector<std::int32_t>& set : connectedSets(graph, open)) {
        if (std::find(set.begin(), set.end(), tree.root) != set.end())
            continue;
        for (const std::int32_t n : set)
            branch.beyond[std::size_t(n)] = 1;
    }
    for (std::size_t n = 0; n < graph.count(); ++n)
        if (branch.beyond[n]) {
            branch.widest_mm = std::max(branch.widest_mm, double(graph.nodes[n].wall_mm));
            const double length = tree.length_mm[n] - tree.length_mm[std::size_t(neck.node)];
            if (branch.farthest < 0 || length > branch.length_mm) {
                branch.length_mm = length;
                branch.farthest = std::int32_t(n);
            }
        }
    return branch;
}

void findColonBeside(Branch& branch, const LumenGraph& graph, const LumenTree& tree, const Neck& neck,
                     Progress& progress)
{
    const LumenTree without = centralTree(graph, tree.root, closedAt(graph, neck), progress);
    branch.end = farthestNode(without);
    const std::vector<std::int32_t> to_end = without.pathTo(branch.end), to_neck = tree.pathTo(neck.node);
    std::size_t common = 0;
    while (common + 1 < std::min(to_end.size(), to_neck.size()) && to_end[common + 1] == to_neck[common + 1])
        ++common;
    branch.junction = to_end[common];
    const auto along = [&](std::int32_t n) { return double(without.length_mm[std::size_t(n)]); };
    branch.pouch_mm = along(branch.end) - along(branch.junction);
    for (const std::int32_t n : to_end) {
        const double after = along(n) - along(branch.junction);
        if (after <= 0 && after > -60)
            branch.colon_radius_mm = std::max(branch.colon_radius_mm, double(graph.node(n).wall_mm));
        if (after >= branch.pouch_mm / 4)
            branch.pouch_radius_mm = std::max(branch.pouch_radius_mm, double(graph.node(n).wall_mm));
    }
}

}  // namespace vicon::steps
