#pragma once

#include "vicon/cases/polyp_size.h"

namespace vicon {

/// A click this near to a polyp means it.
inline constexpr double kPolypCatch_mm = 2;

/// Outlines what stands at a point of the wall, if its head holds `place` or lies within kPolypCatch_mm of it.
/// @param from within kPolypCatch_mm of the surface; else Error{bad_input}
PolypOutline outlineFrom(const CellSurface& surface, Point3 from, Point3 place, double blur_mm, const Progress* wanted);

}  // namespace vicon
