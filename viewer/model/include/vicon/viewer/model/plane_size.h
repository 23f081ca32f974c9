#pragma once

#include <optional>

#include "vicon/cases/marker_measures.h"
#include "vicon/core/progress.h"
#include "vicon/core/volume_view.h"
#include "vicon/viewer/model/camera.h"

namespace vicon::viewer {

/// Turns a plane about the line through two points of the wall, up to 60 degrees from upright on it, and takes the
/// plane in which what stands above the line has the largest cross-section; the diameter is the greatest distance
/// between two points of that cross-section, the clicked ones included. What hangs over beyond the points belongs to
/// it, the wall that curves up there does not. A diameter runs through tissue, at most a fifth of it beside.
/// Nothing where nothing stands above the line in any plane, it is nowhere bounded by lumen, the line runs through the
/// lumen, or the points are less than 1 or more than 80 mm apart. Throws Error{cancelled} where `wanted` is no longer.
/// @param eye a place in the lumen from which the points are seen
std::optional<PlaneSize> sizeOnBestPlane(const InsideView& inside, Point3 a, Point3 b, Point3 eye,
                                         const Progress* wanted = nullptr);

/// The plane as a picture with the lumen above; what is `field_mm` wide around the line's middle.
PlaneView viewOf(const PlaneSize& size, int width, int height, double field_mm);

}  // namespace vicon::viewer
