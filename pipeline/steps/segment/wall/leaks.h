#pragma once

#include <vector>

#include "vicon/core/volume.h"
#include "vicon/steps/segment.h"

namespace vicon::steps {

/// Closes what gas leaks through: holes of thin walls (findThinHoles), also where nothing else joins their sides.
/// @param labels on the lattice of `volume`
/// @return the middles of the holes
std::vector<Point3> closeLeaks(const HuVolume& volume, const WallDensities& densities, InsideVolume& labels);

}  // namespace vicon::steps
