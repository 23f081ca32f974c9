#pragma once

namespace vicon::phantom {

/// What the colon and the bowel beside it are made of.
inline constexpr double kGas_hu = -1000, kWall_hu = 42;

}  // namespace vicon::phantom
