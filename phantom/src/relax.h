#pragma once

#include <vector>

#include "anatomy.h"
#include "course.h"

namespace vicon::phantom {

/// A bead of the chain that becomes the colon's axis.
struct Bead {
    Point3 position_mm;
    Point3 anchor_mm;
    double radius_mm = 0;
    double mobility = 0;
    double rest_mm = 0;  ///< distance to the next bead
};

/// Two beads and how far apart they shall come to lie.
struct BeadPair {
    std::size_t a = 0, b = 0;
    double distance_mm = 0;
};

/// Relaxes the chain by projecting its constraints in turn (position based dynamics, Mueller et al. 2007): length of
/// the links, stiffness against bending, loops apart, out of the organs, within the cavity, near the anchors.
void relax(std::vector<Bead>& beads, const Trunk& trunk, double separation_mm, const std::vector<BeadPair>& pulled);

}  // namespace vicon::phantom
