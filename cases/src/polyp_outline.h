#pragma once

#include "surface_patch.h"
#include "vicon/cases/polyp_size.h"

namespace vicon {

/// A click this near to a polyp means it.
inline constexpr double kPolypCatch_mm = 2;

/// Length of a section from the polyp's axis, in a patch as large.
inline constexpr double kPolypSection_mm = 40;

/// Outlines what stands at a point of the wall, if its head holds `place` or lies within kPolypCatch_mm of it.
/// @param from one of the patch's points
PolypOutline outlineFrom(const SurfacePatch& patch, Point3 from, Point3 place, double blur_mm, const Progress* wanted);

}  // namespace vicon
