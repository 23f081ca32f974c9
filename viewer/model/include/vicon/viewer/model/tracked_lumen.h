#pragma once

#include <vector>

#include "vicon/core/volume_view.h"
#include "vicon/viewer/model/camera.h"
#include "vicon/viewer/model/orientation.h"
#include "vicon/viewer/model/path_frames.h"

namespace vicon::viewer {

/// The station for the next slice of a lumen that is followed in two dimensions: where the centreline has moved by a
/// slice across the plane or, where it runs along the plane, by 4 mm within it. At the ends: the end.
/// @param across unit vector across the slices
/// @param slices how many; negative: towards the first end
double stationSlicesOn(const PathFrames& path, double station_mm, Vector3 across, double slice_mm, int slices);

/// The slice across the lumen at the place of the centreline that is nearest to a point. It is seen the way the eye
/// looks along the centreline, and rolled as the eye is: what the view from inside has above is above in it, too.
/// @param eye anywhere on the way: it is carried along to that place
SliceAxes axesAcross(const PathFrames& way, Point3 point, const Pose& eye);

/// The rim of the lumen that a slice cuts around a place, other loops left out, as a smooth line: how much of each
/// pixel it covers, 0 to 1. All 0 where the place is not in the lumen.
/// @param in_lumen near the plane; the lumen is looked for within 3 mm of where it is in the picture
std::vector<float> lumenRim(const InsideView& inside, const PlaneView& view, Point3 in_lumen);

}  // namespace vicon::viewer
