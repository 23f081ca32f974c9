#include "vicon/viewer/model/free_flight.h"

#include <algorithm>
#include <cmath>

#include "free_space.h"
#include "rotation.h"

namespace vicon::viewer {
namespace {

constexpr double kDt = Submarine::kTick_s;
constexpr double kAtRest_mm_s = 0.01;  // what is slower is at rest: no picture shows it
constexpr double kBackOff_mm_s = 30;   // out of a place that is too narrow
constexpr double kLeastWall_mm = 0.5;  // the push does not grow further

}  // namespace

Pose withViewTurned(const Pose& pose, const Steering& steering, double angle_rad)
{
    Pose next = pose;
    const Vector3 right = pose.right();
    next.forward = rotated(next.forward, next.up * (-steering.turn_right * angle_rad));
    next.forward = normalized(rotated(next.forward, right * (steering.turn_up * angle_rad)));
    next.up = uprightOn(next.forward, next.up);
    return next;
}

Vector3 FreeFlight::pushOffWall(Point3 eye_mm) const
{
    const double reach = kWallReach_mm;
    const double wall = std::max(lumen_.clearance_mm(eye_mm), kLeastWall_mm);
    if (wall >= reach)
        return {};
    const double slope = 2 * Submarine::kWallStrength_mm2_s2 * (reach / wall - 1) * reach / (wall * wall);
    return lumen_.clearanceGradient(eye_mm) * slope;
}

/// From where there is too little room, as after a click on the wall: up the potential, until there is enough.
void FreeFlight::backOff(Point3& eye_mm) const
{
    const Point3 next = eye_mm + normalized(lumen_.clearanceGradient(eye_mm)) * (kBackOff_mm_s * kDt);
    if (lumen_.inside(next) && lumen_.clearance_mm(next) > lumen_.clearance_mm(eye_mm))
        eye_mm = next;
}

void FreeFlight::tick(Pose& pose, const Steering& steering, double speed_mm_s)
{
    if (steering.turns())
        pose = withViewTurned(pose, steering, radians(Submarine::kTurning_deg_s) * kDt);
    const FreeSpace free(lumen_, kCameraRadius_mm);
    if (!free.holds(pose.eye_mm)) {
        stop();
        backOff(pose.eye_mm);
        return;
    }
    const Vector3 thrust =
        (pose.forward * steering.thrust_forward + pose.right() * steering.thrust_right + pose.up * steering.thrust_up) *
        speed_mm_s;
    // The wall's push is a force, the thrust a speed that friction lets it reach.
    const double left = std::exp(-Submarine::kFriction_per_s * kDt);
    velocity_mm_s_ = velocity_mm_s_ * left + thrust * (1 - left) + pushOffWall(pose.eye_mm) * kDt;
    if (!steering.thrusts() && length(velocity_mm_s_) < kAtRest_mm_s)
        stop();
    pose.eye_mm = free.moved(pose.eye_mm, velocity_mm_s_, kDt);
}

void FreeFlight::moveBy(Pose& pose, Vector3 way_mm)
{
    const FreeSpace free(lumen_, kCameraRadius_mm);
    const int steps = std::max(1, int(std::ceil(length(way_mm) / FreeSpace::kMostStep_mm)));
    stop();
    for (int n = 0; n < steps; ++n) {
        Vector3 step = way_mm / steps;
        pose.eye_mm = free.moved(pose.eye_mm, step, 1);
    }
}

}  // namespace vicon::viewer
