#include "vicon/viewer/model/navigator.h"

#include <algorithm>
#include <cmath>

namespace vicon::viewer {
namespace {

Heading opposite(Heading heading)
{
    return heading == Heading::caecum ? Heading::rectum : Heading::caecum;
}

}  // namespace

Navigator::Navigator(const PathFrames& path, const Lumen& lumen, const std::optional<FieldView>& exit_distance)
    : path_(&path), lumen_(lumen), ahead_(path, lumen), free_flight_(lumen_)
{
    if (path.isPath())
        submarine_.emplace(path, lumen_, exit_distance.value());
    else
        mode_ = NavigationMode::free;
    jumpTo(0);
}

void Navigator::setMode(NavigationMode mode)
{
    if (mode == mode_ || !hasPath())
        return;
    const NavigationState now = state();
    station_mm_ = now.station_mm;
    free_ = now.pose;
    owed_s_ = 0;
    direction_ = 0;
    mode_ = mode;
    if (mode == NavigationMode::guided)
        submarine_->placeAt(station_mm_, heading_);
}

void Navigator::setHeading(Heading heading)
{
    heading_ = heading;
    if (submarine_)
        submarine_->setHeading(heading);
}

void Navigator::setSpeed(double mm_s)
{
    speed_mm_s_ = std::clamp(mm_s, kLeastSpeed_mm_s, kMostSpeed_mm_s);
}

void Navigator::jumpTo(double station_mm)
{
    direction_ = 0;
    station_mm_ = std::clamp(station_mm, 0.0, path_->length_mm());
    free_flight_.stop();
    if (submarine_)
        submarine_->placeAt(station_mm_, heading_);
    if (mode_ == NavigationMode::free)
        free_ = poseHere();
}

void Navigator::step(double mm)
{
    if (hasPath())
        jumpTo(state().station_mm + sign() * mm);
    else
        moveBy(free_.forward * mm);
}

void Navigator::moveBy(Vector3 way_mm)
{
    if (!hasPath())
        free_flight_.moveBy(free_, way_mm);
}

void Navigator::lookFrom(const Pose& pose, double station_mm)
{
    direction_ = 0;
    free_flight_.stop();
    station_mm_ = std::clamp(station_mm, 0.0, path_->length_mm());
    mode_ = NavigationMode::free;
    free_ = lumen_.inside(pose.eye_mm) ? pose : poseHere();
}

// The submarine stays where it was while the eye is led by another mode.
void Navigator::goBackTo(const Place& place)
{
    direction_ = 0;
    owed_s_ = 0;
    free_flight_.stop();
    mode_ = place.mode;
    station_mm_ = place.station_mm;
    look_back_ = place.looks_back;
    free_ = place.free;
    constexpr double kElsewhere_mm = 1;
    if (mode_ == NavigationMode::guided && std::abs(submarine_->state().station_mm - station_mm_) > kElsewhere_mm)
        submarine_->placeAt(station_mm_, heading_);  // the click was a jump
}

void Navigator::advance(double seconds)
{
    switch (mode_) {
        case NavigationMode::planned:
            advancePlanned(seconds);
            break;
        case NavigationMode::guided: {
            Steering steering = steering_;
            steering.drift = direction_;
            submarine_->steer(steering);
            submarine_->advance(seconds);
            break;
        }
        case NavigationMode::free:
            owed_s_ += seconds;
            for (; owed_s_ >= Submarine::kTick_s; owed_s_ -= Submarine::kTick_s)
                if (hasPath())
                    tickFree();
                else
                    free_flight_.tick(free_, steering_, speed_mm_s_);
            break;
    }
}

double Navigator::speedAt_mm_s(double station_mm) const
{
    constexpr double kMostTurn_deg_s = 90;  // of the view: what turns faster cannot be read
    const double turn_rad_mm = ahead_.turn_rad_mm(station_mm, look_back_ ? opposite(heading_) : heading_);
    return std::clamp(radians(kMostTurn_deg_s) / std::max(turn_rad_mm, 1e-9), kLeastSpeed_mm_s / 2, speed_mm_s_);
}

// Piece by piece of the path, each at a speed of its own: so that what is reached does not depend on the frame rate.
void Navigator::advancePlanned(double seconds)
{
    constexpr double kPiece_mm = 2, kRounding = 1e-9;
    const double way = sign() * direction_;
    while (seconds > 0 && way != 0) {
        const double place = station_mm_ / kPiece_mm;
        const double piece = way > 0 ? std::floor(place + kRounding) : std::ceil(place - kRounding);
        const double next_mm = std::clamp((piece + way) * kPiece_mm, 0.0, path_->length_mm());
        const double speed_mm_s = speedAt_mm_s((piece + way / 2) * kPiece_mm);
        const double needed_s = std::abs(next_mm - station_mm_) / speed_mm_s;
        if (needed_s == 0)
            return;
        station_mm_ = needed_s > seconds ? station_mm_ + way * speed_mm_s * seconds : next_mm;
        seconds -= needed_s;
    }
}

void Navigator::tickFree()
{
    if (steering_.turns())
        free_ = withViewTurned(free_, steering_, radians(Submarine::kTurning_deg_s) * Submarine::kTick_s);
    if (!steering_.thrusts())
        return;
    Vector3 way = (free_.forward * steering_.thrust_forward + free_.right() * steering_.thrust_right +
                   free_.up * steering_.thrust_up) *
                  (speed_mm_s_ * Submarine::kTick_s);
    const auto fits = [&](Point3 p) { return lumen_.clearance_mm(p) >= kCameraRadius_mm; };
    const bool leaves_wall = lumen_.clearance_mm(free_.eye_mm + way) > lumen_.clearance_mm(free_.eye_mm);
    if (!fits(free_.eye_mm + way) && !leaves_wall) {  // slide along the wall
        const Vector3 off = normalized(lumen_.clearanceGradient(free_.eye_mm));
        way -= off * std::min(0.0, dot(way, off));
    }
    const Point3 next = free_.eye_mm + way;
    if (fits(next) || (lumen_.inside(next) && lumen_.clearance_mm(next) > lumen_.clearance_mm(free_.eye_mm)))
        free_.eye_mm = next;
    constexpr double kReach_mm = 30;  // farther off on the path than a tick can move, nearer than a neighbouring loop
    station_mm_ = path_->nearestStation(free_.eye_mm, station_mm_, kReach_mm);
}

Pose Navigator::poseHere() const
{
    return poseAtStation(*path_, lumen_, ahead_, station_mm_, heading_).pose;
}

NavigationState Navigator::state() const
{
    if (mode_ == NavigationMode::guided) {
        const SubmarineState s = submarine_->state();
        return {s.pose, s.station_mm, s.clearance_mm, s.carried, s.at_end};
    }
    if (mode_ == NavigationMode::free)
        return {free_, station_mm_, lumen_.clearance_mm(free_.eye_mm), false, false};
    const ViewPose view =
        poseAtStation(*path_, lumen_, ahead_, station_mm_, look_back_ ? opposite(heading_) : heading_);
    const double end = heading_ == Heading::caecum ? path_->length_mm() : 0;
    constexpr double kOff_mm = 2;  // the pose of a place that is too narrow lies elsewhere
    return {view.pose, station_mm_, view.clearance_mm, std::abs(view.station_mm - station_mm_) > kOff_mm,
            station_mm_ == end};
}

}  // namespace vicon::viewer
