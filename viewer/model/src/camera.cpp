#include "vicon/viewer/model/camera.h"

namespace vicon::viewer {

Projected project(const Pose& pose, const Lens& lens, Point3 p)
{
    const Vector3 d = p - pose.eye_mm;
    const double depth = dot(d, pose.forward);
    if (depth <= 0)
        return {{}, depth};
    const double scale = lens.focal_px() / depth;
    return {{lens.width / 2.0 + dot(d, pose.right()) * scale, lens.height / 2.0 - dot(d, pose.up) * scale}, depth};
}

Vector3 rayThrough(const Pose& pose, const Lens& lens, Pixel at)
{
    const double f = lens.focal_px();
    return normalized(pose.forward + pose.right() * ((at.x - lens.width / 2.0) / f) -
                      pose.up * ((at.y - lens.height / 2.0) / f));
}

Vector3 uprightOn(Vector3 forward, Vector3 wanted)
{
    constexpr double kTooShort = 1e-6;
    Vector3 up = wanted - forward * dot(wanted, forward);
    if (length(up) < kTooShort) {
        const Vector3 other = std::abs(forward.z) < 0.9 ? Vector3{0, 0, 1} : Vector3{0, -1, 0};
        up = other - forward * dot(other, forward);
    }
    return normalized(up);
}

Pose lookAt(Point3 eye, Point3 target, Vector3 up_wanted)
{
    const Vector3 forward = normalized(target - eye);
    return {eye, forward, uprightOn(forward, up_wanted)};
}

}  // namespace vicon::viewer
