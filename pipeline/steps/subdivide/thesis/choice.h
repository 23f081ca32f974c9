#pragma once

#include <vector>

#include "subdivide/thesis/walk.h"

namespace vicon::steps {

/// A selection of portals and what it costs: the sum of the portals' badness and of the squared logarithmic deviations
/// of the segments' sizes.
struct PortalChoice {
    std::vector<CutPlane> planes;  ///< in order of the path; no two of them intersect
    double cost = 0;
    double at_least = 0;         ///< no selection costs less; equal to `cost` where the optimum is proved
    double neighbours_only = 0;  ///< of keeping apart only portals that follow each other, and dropping what meets yet
};

/// The selection of least cost over all planes, no two intersecting, wherever along the path they lie.
/// Method: a dynamic programme that keeps neighbours apart; where two others of its selection meet, either the one is
/// out or all that meets it, and both are solved anew, the cheapest first (branch and bound). Given up after
/// `most_solved` programmes, with the best selection so far.
PortalChoice choosePortals(const PlanesAt& planes, const PathSizes& sizes, Progress& progress, int most_solved = 400);

}  // namespace vicon::steps
