#pragma once

#include <vector>

#include "anatomy.h"
#include "random.h"
#include "relax.h"

namespace vicon::phantom {

/// The usual way, varied as patients vary.
std::vector<WayPoint> variedWay(Random& random);

/// Beads along the way whose links together are `length_mm` long: what is mobile takes up the slack.
std::vector<Bead> beadsAlong(const std::vector<WayPoint>& way, double length_mm);

/// Where the stops of a way of `stops` points lie on its beads, as fractions of the length.
std::vector<double> stopFractions(const std::vector<Bead>& beads, std::size_t stops);

/// Stations of those fractions of the chain, whose links the relaxing may have stretched unevenly.
std::vector<double> stationsOnChain(const std::vector<Bead>& beads, const std::vector<double>& fractions,
                                    double length_mm);

/// The chain again with links of even length: bending stiffness then means the same everywhere.
std::vector<Bead> evenBeads(const std::vector<Bead>& beads);

/// Turning over: the mobile parts shift, the front is pressed flat.
void turnOver(std::vector<Bead>& beads, Position position, Random& random);

}  // namespace vicon::phantom
