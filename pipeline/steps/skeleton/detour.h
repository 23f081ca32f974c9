#pragma once

#include "skeleton/smooth.h"

namespace vicon::steps {

/// Leads a curve through the middle of the rectum round a rectal tube that lies there: every stretch that is not in the
/// lumen moves sideways, always to the same side of the tube, as little and as evenly as the lumen allows.
/// @param wall of the lumen without the tube
Polyline besideTube(const Polyline& line, const DistanceProbe& wall, double step_mm);

}  // namespace vicon::steps
