#pragma once

#include <vector>

#include "skeleton/smooth.h"

namespace vicon::steps {

/// How much a line swings at each of its points, from 0 to 1. A lumen that leads on has no bend that is tighter than it
/// is wide, for its inner wall would be a point. A line that has one swings within a wide lumen: between folds that
/// stand on its sides by turns, for the sections across it swing with it, and recentring makes more of that.
/// @param line evenly spaced, inside the lumen
std::vector<double> swingsOf(const Polyline& line, const DistanceProbe& wall, double step_mm);

}  // namespace vicon::steps
