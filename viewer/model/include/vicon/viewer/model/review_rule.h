#pragma once

#include <cstdint>
#include <vector>

#include "vicon/viewer/model/camera.h"

namespace vicon::viewer {

/// When wall that is in a picture counts as reviewed: it is seen steeply (angle between the ray and the wall's normal),
/// large enough on the screen (96 pixels to the inch), and for long enough. What is counted so is defined by these;
/// they were not chosen by cases.
inline constexpr double kMostIncidence_deg = 60, kLeastScale_px_mm = 3, kLeastShown_s = 0.1;

/// Those of the triangles in a picture that are looked at steeply and closely enough.
/// @param points_mm x, y, z of each point, LPS
/// @param triangles three point numbers each
/// @param shown numbers of the triangles in the picture
/// @param pixel_ratio of the screen
std::vector<std::uint32_t> wellShown(const std::vector<float>& points_mm, const std::vector<std::uint32_t>& triangles,
                                     const std::vector<std::uint32_t>& shown, const Pose& pose, const Lens& lens,
                                     double pixel_ratio = 1);

}  // namespace vicon::viewer
