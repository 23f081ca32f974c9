#pragma once

#include <vector>

#include "skeleton/smooth.h"

namespace vicon::steps {

/// Points of a line about as far apart as `step_mm`, and how near the evened line has to pass each.
struct KnownLine {
    Polyline points;
    std::vector<double> weights;  ///< 0 where nothing is known

    /// Appends points of one weight; over the distance to the first of them nothing is known.
    void add(const Polyline& more, double weight, double step_mm);
};

/// The weight with which everything shorter than about `scale_mm` is evened out.
double weightFor(double scale_mm, double step_mm);

/// A weight that pins the line to a point.
inline constexpr double kPinned = 1e6;

/// The line that is nearest to what is known and whose bend changes least: a smoothing spline of the fifth degree.
/// Has as many points as what is known.
Polyline evened(const KnownLine& known);

}  // namespace vicon::steps
