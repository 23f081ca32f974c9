#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "vicon/core/progress.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

/// The lumen thinned to one voxel per block: the one farthest from the wall.
struct LumenGraph {
    struct Node {
        Index3 voxel;
        float wall_mm = 0;  ///< distance to the wall
    };
    /// A node's neighbours, in the 27 blocks around it, i fastest. Nodes in a row of three blocks have successive
    /// numbers, so few bytes tell all of them.
    struct Links {
        std::array<std::uint32_t, 9> first{};  ///< the first node in each row of three
        std::uint32_t there = 0;               ///< bit n: there is a node in block n
        std::uint32_t joined = 0;              ///< bit n: and it is joined to the node in the middle
    };

    Grid grid;                 ///< of the mask and its distances
    int block = 2;             ///< edge of a block, voxels; 1 keeps every voxel
    std::vector<Node> nodes;   ///< in the order of their blocks
    std::vector<Links> links;  ///< of each node

    std::size_t count() const { return nodes.size(); }
    const Node& node(std::int32_t n) const { return nodes[std::size_t(n)]; }
    Point3 point(std::int32_t n) const { return grid.pointAt(node(n).voxel); }
    /// The node nearest to a point, -1 without nodes.
    std::int32_t nearest(Point3 p) const;
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

/// @param wall_mm distance to the wall, 0 outside the lumen
/// Neighbouring nodes are joined where their balls up to the wall overlap or a straight line between them stays inside,
/// so that no edge crosses a thin wall.
/// @param least_mm blocks that are nowhere farther from the wall are left out
LumenGraph makeGraph(const FieldVolume& wall_mm, int block, double least_mm);

/// The coarsest graph, of blocks of `coarsest` voxels or half, a quarter, ... of that, which hangs together as well as
/// the lumen does: from its widest node it reaches nearly every block.
LumenGraph makeWholeGraph(const FieldVolume& wall_mm, int coarsest, Progress& progress);

/// The node farthest from the wall, -1 without nodes.
std::int32_t widestNode(const LumenGraph& graph);

/// What a millimetre costs a central way at a place so far from the wall: (5 mm / wall distance)^4. The 5 mm only scale
/// the cost.
inline float centralCost(float wall_mm)
{
    const float ratio = 5 / std::max(0.1F, wall_mm);
    return ratio * ratio * ratio * ratio;
}

/// Shortest paths from a root to every node that it reaches.
struct LumenTree {
    std::int32_t root = -1;
    std::vector<std::int32_t> parent;  ///< -1 for the root and what is not reached
    std::vector<float> cost;           ///< infinite where not reached
    std::vector<float> length_mm;      ///< along the tree, from the root
    bool reaches(std::int32_t node) const { return node == root || parent[std::size_t(node)] >= 0; }
    std::vector<std::int32_t> pathTo(std::int32_t node) const;  ///< from the root, both included
};

/// Dijkstra with an edge cost of length x centralCost(): the tree keeps to the middle and avoids contacts
/// between loops, which are narrow.
/// @param blocked nodes that must not be used; empty: none
/// @param goal a node at which the search may end: then only the way to it is whole; -1: none
LumenTree centralTree(const LumenGraph& graph, std::int32_t root, const std::vector<std::uint8_t>& blocked,
                      Progress& progress, std::int32_t goal = -1);

/// Geodesic distance of every node from a set of nodes, and which of them is nearest.
struct LumenFeet {
    std::vector<float> distance_mm;  ///< infinite where not reached
    std::vector<std::int32_t> foot;  ///< number of the source in the list given, -1 where not reached
};
LumenFeet feetOn(const LumenGraph& graph, const std::vector<std::int32_t>& sources);

/// Sets of nodes, out of those chosen, that hang together in the graph; smallest node first.
std::vector<std::vector<std::int32_t>> connectedSets(const LumenGraph& graph, std::vector<std::uint8_t> chosen);

/// The reached node that is farthest along the tree.
std::int32_t farthestNode(const LumenTree& tree);

}  // namespace vicon::steps
