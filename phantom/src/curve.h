#pragma once

#include <vector>

#include "course.h"
#include "relax.h"

namespace vicon::phantom {

/// Control values of a uniform cubic B-spline at a place between 0 and their number - 1.
Point3 splinePoint(const std::vector<Point3>& control, double at);
double splineValue(const std::vector<double>& control, double at);

/// The smooth curve that the beads control, sampled evenly every 1 mm or so, with its frames and bends.
Course curveThrough(const std::vector<Bead>& beads);

}  // namespace vicon::phantom
