#pragma once

#include <vector>

#include "scene.h"
#include "vicon/phantom/phantom.h"
#include "wall.h"

namespace vicon::phantom {

/// The end of the small bowel: a valve in the medial wall of the ascending colon, a few centimetres above the caecum's
/// end, and a tube that runs on from it. Where the colon is filled with fluid at the valve, the ileum holds the same
/// pool; elsewhere gas, or gas over a level of its own.
struct Ileum {
    std::vector<Solid> wall;   ///< painted before the colon
    std::vector<Solid> lumen;  ///< painted after it
    TerminalIleum truth;
};

/// Draws the ileum of this patient in this position. Throws Error{internal} when no way of 100 mm is free.
Ileum drawIleum(std::uint64_t seed, const DrawnCourse& drawn, const Wall& wall, const std::vector<FluidPool>& pools,
                Position position);

}  // namespace vicon::phantom
