#pragma once

#include <cstdint>
#include <vector>

#include "vicon/viewer/model/camera.h"

namespace vicon::viewer {

/// When wall that is in a picture counts as reviewed: it is seen steeply, large enough on the screen, and for long
/// enough.
struct ReviewRule {
    double most_incidence_deg = 60;  ///< between the ray and the wall's normal
    double least_px_per_mm = 3;      ///< of the screen, 96 to the inch
    double least_s = 0.1;
};

/// Those of the triangles in a picture that are looked at steeply and closely enough.
/// @param points_mm x, y, z of each point, LPS
/// @param triangles three point numbers each
/// @param shown numbers of the triangles in the picture
/// @param pixel_ratio of the screen
std::vector<std::uint32_t> wellShown(const std::vector<float>& points_mm, const std::vector<std::uint32_t>& triangles,
                                     const std::vector<std::uint32_t>& shown, const Pose& pose, const Lens& lens,
                                     double pixel_ratio = 1, const ReviewRule& rule = {});

}  // namespace vicon::viewer
