#pragma once

#include <vector>

#include "vicon/core/skeleton.h"

namespace vicon {

/// The middle of a lumen between two forks, or from a fork to a tip.
struct SkeletonBranch {
    int parent = -1;                    ///< number of the branch that it leaves; -1: the root's
    int generation = 0;                 ///< forks between the root and the branch
    std::vector<SkeletonPoint> points;  ///< at least two; `station_mm` from the root; begins where the parent ends
};

/// The skeleton of an organ that branches. Branches in depth-first order: a parent before its children, of several
/// children the one first that leads farthest from the root.
struct SkeletonTree {
    std::vector<SkeletonBranch> branches;

    bool empty() const { return branches.empty(); }
    /// Numbers of the branches that end in a tip, the farthest from the root first.
    std::vector<int> tips() const;
    /// The way from the root to the end of a branch, as one piece of skeleton. Throws Error{wrong_use} for a number
    /// that no branch has.
    Skeleton pathTo(int branch) const;
    /// All branches as pieces, stations from the root: pieces whose stations overlap, unlike those of a colon.
    Skeleton allBranches() const;
    /// Of the whole tree: the lengths of all branches together.
    double totalLength_mm() const;
};

}  // namespace vicon
