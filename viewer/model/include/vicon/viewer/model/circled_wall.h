#pragma once

#include <optional>

#include "vicon/cases/density_sample.h"
#include "vicon/viewer/model/lumen.h"

namespace vicon::viewer {

/// The wall beside a circle in a slice, where the lumen is nearest to its middle, and how far that stands up over the
/// wall around the circle, up to twice its radius away; at most to the circle's far side. Nothing where the circle
/// stays more than 2 mm from the lumen, the margin that sampleDensity() keeps: all of it is sampled.
/// @param middle in tissue
std::optional<CircledWall> circledWall(const Lumen& lumen, Point3 middle, double radius_mm);

}  // namespace vicon::viewer
