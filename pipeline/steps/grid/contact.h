#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid/lumen_graph.h"
#include "vicon/steps/skeleton.h"

namespace vicon::steps {

using NodePath = std::vector<std::int32_t>;  ///< each joined to the next

/// A part of the lumen far from the path, and the stretch of the path beside which it lies.
struct LeftOut {
    std::vector<std::int32_t> nodes;
    std::size_t from = 0;  ///< numbers of the first and the last node of the path that it hangs on
    std::size_t to = 0;
};

struct PathCoverage {
    double uncovered_fraction = 0;  ///< of the reached nodes, in all that is left out
    std::vector<LeftOut> parts;     ///< those that matter, largest first
};

PathCoverage coverageOf(const LumenGraph& graph, const NodePath& path, const SkeletonOptions& options);

// Chosen on the rings of loop_contacts_test.cpp, which are 150 mm longer than the way past them, and on loops of 800 mm
// with folds that leave less than the hole: so long a way around is no pouch, however narrow its folds.
inline constexpr float kLongerThanPouch_mm = 300;

/// What may be a hole between two loops, through which the path goes.
struct Contact {
    Point3 narrowest_mm;
    std::vector<std::vector<std::int32_t>> bars;  ///< sets of nodes to bar, the best first; none: there is no contact
    bool wider_around = false;  ///< both sides are joined to the part left out by lumen wider than the hole all the way
};

/// Finds the hole through which the path comes by the mouths of a part that it leaves out. What tells a hole from a
/// narrow place of the colon is that there is another way: a lumen, wide on either side, that leads into that part.
/// Both sides are looked at well beyond the mouths, which are no wider than the hole.
/// @param tried narrowest places of those that are passed over
Contact contactBeside(const LumenGraph& graph, const NodePath& path, const LeftOut& part,
                      const std::vector<Point3>& tried);

}  // namespace vicon::steps
