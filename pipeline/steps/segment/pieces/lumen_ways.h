#pragma once

#include <cstdint>
#include <vector>

#include "grid/contact.h"
#include "grid/lumen_graph.h"
#include "vicon/core/progress.h"

namespace vicon::steps {

/// The way through the middle of a tube of lumen, from one of its ends to the other.
struct LumenWay {
    LumenTree tree;  ///< from its first node; reaches all that hangs together with it
    NodePath nodes;

    double length_mm() const { return double(tree.length_mm[std::size_t(nodes.back())]); }
};

/// The ways through a lumen whose loops do not touch.
struct LumenWays {
    std::vector<LumenWay> ways;        ///< more than one where parts of the lumen hang together by contacts alone
    std::vector<std::uint8_t> barred;  ///< 1 for nodes of the graph that lie in contacts; empty: there are none
};

/// Finds the ends of the lumen, and the ways between them. Ends are the places farthest from one another along the
/// middle. Where two loops touch through a hole such a place may be the middle of a loop, at which the ways around it
/// meet. So contacts are looked for on the ways into what is left out, the one is barred without which least is left
/// out, and the ends are sought again, until nothing changes. A bar must open a ring of lumen, or part two tubes that
/// lead past one another: strictures, pouches and ileum do neither. Without a contact there is one way, the longest.
/// @param graph with nodes; what does not hang together with the widest of them is left aside
LumenWays findWays(const LumenGraph& graph, Progress& progress);

}  // namespace vicon::steps
