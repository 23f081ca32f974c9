#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "grid/lumen_graph.h"
#include "vicon/core/progress.h"

namespace vicon::steps {

/// A narrow place of the tree and what lies behind it.
struct Neck {
    std::int32_t node = -1;
    double behind_ml = 0;
};

/// Places of the tree with a radius of at most `widest_mm`, narrowest of their surroundings, behind which between
/// `least_ml` and `most_ml` of lumen lie: most first.
std::vector<Neck> necksOf(const LumenGraph& graph, const LumenTree& tree, double widest_mm, double least_ml,
                          double most_ml);

/// What lies on the far side of a neck, and how the colon goes on without it.
struct Branch {
    std::vector<std::uint8_t> beyond;  ///< of every node: 1 on the far side
    double widest_mm = 0;              ///< radius
    double length_mm = 0;
    std::int32_t farthest = -1;  ///< of the branch
    std::int32_t end = -1;       ///< of the colon without the branch
    std::int32_t junction = -1;  ///< where the ways to the neck and to that end part
    double pouch_mm = 0;         ///< from there to the end
    double pouch_radius_mm = 0;  ///< widest on that way, half of the pouch beyond the junction
    double colon_radius_mm = 0;  ///< widest before the junction
};

/// The branch behind a neck, found by closing the neck; without value where the tree's root lies in it. How the colon
/// goes on is left open.
std::optional<Branch> branchAt(const LumenGraph& graph, const LumenTree& tree, const Neck& neck);

/// Fills in how the colon goes on without a branch. Costs a tree of the whole graph.
void findColonBeside(Branch& branch, const LumenGraph& graph, const LumenTree& tree, const Neck& neck,
                     Progress& progress);

}  // namespace vicon::steps
