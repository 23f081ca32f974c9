#pragma once

#include <string>
#include <vector>

#include "grid/run_labels.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

/// How far a person's point may lie beside what it means: a click in a slice of the
/// whole body is good to a pixel or two, some 2 mm.
inline constexpr double kCatch_mm = 3;

/// "x,y,z" for a person, in whole mm.
std::string textOf(Point3 point);

/// The components at, or within kCatch_mm of, each point; points without one are left out.
std::vector<int> componentsAt(const RunLabels& labels, const Grid& grid, const std::vector<Point3>& points);

}  // namespace vicon::steps
