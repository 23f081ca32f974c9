#pragma once

#include "surface_patch.h"
#include "vicon/cases/polyp_size.h"

namespace vicon {

/// A click this near to a polyp means it.
inline constexpr double kPolypCatch_mm = 2;

/// Of the surface that is looked at, from the point where that begins.
inline constexpr double kPolypPatch_mm = 40;

/// What was made out at one place of the wall.
struct TriedOutline {
    PolypOutline outline;
    bool decided = false;  ///< outlined, or refused for what lies around it: no other place of the wall need be tried
};

/// Outlines what stands at a point of the wall, if its head holds `place` or lies within kPolypCatch_mm of it.
/// @param from one of the patch's points
/// @param lumen the scan's; its axes are those of the planes
TriedOutline outlineFrom(const SurfacePatch& patch, const InsideView& lumen, Point3 from, Point3 place,
                         const BlurAndNoise& scan, const Progress* wanted);

}  // namespace vicon
