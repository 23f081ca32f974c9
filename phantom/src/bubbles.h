#pragma once

#include <vector>

#include "course.h"
#include "vicon/phantom/phantom.h"
#include "wall.h"

namespace vicon::phantom {

/// Draws bubbles of gas that float in the pools, the upper ones cut by the level. Fewer where there is no room.
std::vector<GasBubble> drawBubbles(const PhantomOptions& options, const Course& course, const Wall& wall,
                                   const std::vector<FluidPool>& pools, Position position);

}  // namespace vicon::phantom
