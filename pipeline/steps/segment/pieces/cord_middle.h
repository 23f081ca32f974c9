#pragma once

#include "skeleton/smooth.h"
#include "vicon/core/progress.h"
#include "vicon/core/volume.h"
#include "vicon/steps/wall_densities.h"

namespace vicon::steps {

/// A line through a collapsed part moved to the middle of the bowel's outer wall, as far as fat around it shows that
/// wall: where the lumen closes it often does so in a corner, and the cheapest way through a bent cord cuts the bend.
/// @param line evenly spaced, 1 mm, from lumen to lumen
/// @param inside the lumen; it counts as bowel
Polyline middleOfCord(const HuVolume& volume, const InsideVolume& inside, const WallDensities& densities,
                      const Polyline& line, Progress& progress);

}  // namespace vicon::steps
