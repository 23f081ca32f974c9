#pragma once

#include <vector>

#include "grid/lumen_graph.h"

namespace vicon::steps {

/// A branch as nodes of the graph: from the fork (or root) that it shares with its parent to its own fork or tip.
struct NodeBranch {
    int parent = -1;
    int generation = 0;
    std::vector<std::int32_t> nodes;
};

/// The branches of a lumen in SkeletonTree's order. `tree` is the central tree from the root; a tip must reach
/// `branch_mm` beyond the wall of what it leaves.
std::vector<NodeBranch> branchesOf(const LumenGraph& graph, const LumenTree& tree, double branch_mm,
                                   Progress& progress);

}  // namespace vicon::steps
