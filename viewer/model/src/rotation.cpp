#include "rotation.h"

#include <algorithm>
#include <numbers>

namespace vicon::viewer {

Vector3 rotated(Vector3 v, Vector3 turn)
{
    const double angle = length(turn);
    if (angle == 0)
        return v;
    const Vector3 axis = turn / angle;
    const double c = std::cos(angle), s = std::sin(angle);
    return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1 - c));
}

Vector3 rotationBetween(Vector3 forward_a, Vector3 up_a, Vector3 forward_b, Vector3 up_b)
{
    const Vector3 right_a = cross(forward_a, up_a), right_b = cross(forward_b, up_b);
    const double trace = dot(forward_a, forward_b) + dot(up_a, up_b) + dot(right_a, right_b);
    const double angle = std::acos(std::clamp((trace - 1) / 2, -1.0, 1.0));
    const Vector3 axis = (cross(forward_a, forward_b) + cross(up_a, up_b) + cross(right_a, right_b)) / 2;
    constexpr double kNoAxis = 1e-6;
    if (length(axis) < kNoAxis)
        return angle < 1 ? Vector3{} : up_a * std::numbers::pi;
    return normalized(axis) * angle;
}

}  // namespace vicon::viewer
