#pragma once

#include <vector>

#include "vicon/core/progress.h"
#include "vicon/viewer/model/lumen.h"

namespace vicon::viewer {

/// How open the lumen is before each point of a surface, 0 to 1: 1 where no other wall is near, less between folds and
/// at the foot of what rises from the wall. This is ambient occlusion taken from the field of wall distances: over
/// plain wall the field grows as fast as one goes away from it, and where other wall is nearer it grows less
/// (A. Evans, Fast approximations for global illumination on dynamic scenes, SIGGRAPH courses 2006).
/// @param points_mm x, y, z of each point, LPS
/// @param normals unit vectors into the lumen, as many as points
/// Throws Error{cancelled} where `wanted`, if there is one, says so.
std::vector<float> opennessOf(const std::vector<float>& points_mm, const std::vector<float>& normals,
                              const Lumen& lumen, const Progress* wanted = nullptr);

}  // namespace vicon::viewer
