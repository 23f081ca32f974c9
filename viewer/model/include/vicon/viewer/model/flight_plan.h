#pragma once

#include <vector>

#include "vicon/viewer/model/view_pose.h"

namespace vicon::viewer {

/// Poses along the path at equal steps, looking where LookAhead says. Bridges and
/// stretches narrower than the camera are left out. Towards the caecum stations rise, towards the rectum they fall.
/// @param step_mm between poses; the last pose is at the end of the path
std::vector<ViewPose> planFlight(const PathFrames& path, const Lumen& lumen, double step_mm, Heading heading);

}  // namespace vicon::viewer
