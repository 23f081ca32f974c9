#pragma once

#include "skeleton/smooth.h"

namespace vicon::steps {

/// The moved line, unwound: where two sections cross inside the lumen, so that their middles do not follow one another,
/// or where the moved line turns more sharply than the lumen is wide, and where it is longer than the path there, it is
/// replaced by the path, moved aside as the moved line is at either end of the stretch. In such a bend every section
/// holds both limbs: moved to their middles again and again the line winds itself up.
/// @param line the line before it was moved, points step_mm apart
/// @param moved the same points afterwards
/// @param path the smoothed voxel path, inside the lumen and in order everywhere, points step_mm apart
Polyline unwound(const Polyline& line, Polyline moved, const Polyline& path, const DistanceProbe& wall, double step_mm);

}  // namespace vicon::steps
