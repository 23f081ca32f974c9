#pragma once

#include <vector>

#include "vicon/core/cell_surface.h"

namespace vicon {

/// The surface around a place in the tissue below it: in each of 26 directions the nearest of its points that face away
/// from the place, the nearest of all first. What is nearer than `catch_mm` counts whichever way it faces.
/// @param surface with normals out of the tissue
/// @param within_mm from the place; what lies farther is left out
std::vector<Point3> surfaceAround(const CellSurface& surface, Point3 at, double within_mm, double catch_mm);

}  // namespace vicon
