#pragma once

#include <vector>

#include "skeleton/smooth.h"

namespace vicon::steps {

/// Each point of a line halfway to where it should go, or as far as the lumen allows.
/// @param to as many points
Polyline halfwayTo(const Polyline& line, const Polyline& to, const DistanceProbe& wall);

/// The mean of lines that follow the same lumen: of each point of the last one and the nearest points of the others.
/// The lines need not have the same number of points. Its points lie inside.
Polyline meanLine(const std::vector<Polyline>& lines, const DistanceProbe& wall);

}  // namespace vicon::steps
