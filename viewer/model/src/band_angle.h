#pragma once

#include <numbers>

namespace vicon::viewer {

/// An angle of less than a turn and a half, from -pi to pi.
inline double turned(double angle_rad)
{
    constexpr double kPi = std::numbers::pi;
    return angle_rad > kPi ? angle_rad - 2 * kPi : angle_rad < -kPi ? angle_rad + 2 * kPi : angle_rad;
}

}  // namespace vicon::viewer
