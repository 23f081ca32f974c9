#pragma once

#include <optional>

#include "vicon/viewer/model/lumen.h"
#include "vicon/viewer/model/path_frames.h"

namespace vicon::viewer {

/// Where a cavity is looked at from first: its widest place, looking where it is deepest, anterior up as far as that
/// allows. Throws Error{unusable_scan} where there is no lumen.
PathFrame homePlace(const Lumen& lumen, const FieldView& wall_distance);

/// The place of a straight line that lies farthest from the wall, within half a metre to both sides; nothing where the
/// line misses the lumen.
std::optional<Point3> roomiestAlong(const Lumen& lumen, Point3 on_line, Vector3 unit_direction);

}  // namespace vicon::viewer
