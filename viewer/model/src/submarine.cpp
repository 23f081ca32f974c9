#include "vicon/viewer/model/submarine.h"

#include <algorithm>
#include <cmath>

#include "free_space.h"
#include "rotation.h"
#include "vicon/core/error.h"

namespace vicon::viewer {
namespace {

constexpr double kDt = Submarine::kTick_s;
constexpr double kFootReach_mm = 8;  // how far a foot moves in a tick at most, with room for folded paths
constexpr double kStationStep_mm = 0.5;
constexpr double kCameraSpare_mm = 0.3;  // a station counts as wide when it leaves this beside the camera
constexpr double kBlend_per_s = 20;      // how fast a camera that is carried comes onto the path
constexpr double kSteerRate_per_s = 8;   // how fast turning follows the hand
// What is slower is at rest: no picture shows it, and as long as the place changes none is drawn smooth.
constexpr double kAtRest_mm_s = 0.01, kAtRest_rad_s = 1e-4;

}  // namespace

Submarine::Submarine(const PathFrames& path, const Lumen& lumen, const FieldView& exit_distance)
    : path_(&path), lumen_(lumen), ahead_(path, lumen), exit_(exit_distance)
{
    placeAt(0, Heading::caecum);
    const double length = path.length_mm();
    for (first_mm_ = 0; first_mm_ < length && !openAt(first_mm_);)
        first_mm_ = std::min(first_mm_ + kStationStep_mm, length);
    for (last_mm_ = length; last_mm_ > first_mm_ && !openAt(last_mm_);)
        last_mm_ = std::max(last_mm_ - kStationStep_mm, first_mm_);
}

FreeSpace Submarine::space() const
{
    return {lumen_, kCameraRadius_mm};
}

bool Submarine::openAt(double station_mm) const
{
    const PathFrame frame = path_->at(station_mm);
    return !frame.on_bridge && lumen_.inside(frame.position_mm) &&
           lumen_.clearance_mm(frame.position_mm) >= lumen_.halfDiagonal_mm();
}

bool Submarine::wideAt(double station_mm) const
{
    const PathFrame frame = path_->at(station_mm);
    const FreeSpace free = space();
    return !frame.on_bridge && free.holds(frame.position_mm) &&
           lumen_.clearance_mm(frame.position_mm) >= free.least_mm() + kCameraSpare_mm;
}

void Submarine::placeAt(double station_mm, Heading heading)
{
    const double length = path_->length_mm();
    const double wanted = std::clamp(station_mm, 0.0, length);
    for (double d = 0; d <= length; d += kStationStep_mm)
        for (const double station : {wanted - d, wanted + d})
            if (station >= 0 && station <= length && wideAt(station)) {
                const PathFrame frame = path_->at(station);
                now_ = {frame.position_mm, {}, {}, {}, frame.up, station, false, heading};
                now_.forward = wayOn();
                now_.up = uprightOn(now_.forward, frame.up);
                before_ = now_;
                way_home_.clear();
                owed_s_ = 0;
                return;
            }
    throw Error(ErrorCode::unusable_scan, "no part of the centreline is wide enough for the camera", {},
                "choose a smaller camera radius");
}

void Submarine::advance(double seconds)
{
    constexpr double kRounding = 1e-6;  // of a tick: so that equal times make equal numbers of ticks at any frame rate
    owed_s_ += seconds;
    while (owed_s_ >= kDt * (1 - kRounding)) {
        before_ = now_;
        tick();
        owed_s_ -= kDt;
    }
}

SubmarineState Submarine::state() const
{
    const double t = std::clamp(owed_s_ / kDt, 0.0, 1.0);
    // Shows the time one tick ago, so that there is always a later moment to interpolate to.
    const Point3 eye = interpolate(before_.position_mm, now_.position_mm, t);
    const Vector3 forward = normalized(before_.forward + (now_.forward - before_.forward) * t);
    SubmarineState s;
    s.pose = {eye, forward, uprightOn(forward, before_.up + (now_.up - before_.up) * t)};
    s.velocity_mm_s = now_.velocity_mm_s;
    s.station_mm = std::lerp(before_.station_mm, now_.station_mm, t);
    s.off_path_mm = distance(now_.position_mm, path_->at(now_.station_mm).position_mm);
    s.clearance_mm = lumen_.clearance_mm(eye);
    s.carried = now_.carried;
    s.heading = now_.heading;
    constexpr double kEnd_mm = 1;
    s.at_end = (sign() > 0 ? last_mm_ - now_.station_mm : now_.station_mm - first_mm_) <= kEnd_mm;
    return s;
}

void Submarine::tick()
{
    if (now_.carried || startCarry()) {
        carry(wantedPull() < 0 ? -sign() : sign());
        turn();
        return;
    }
    move();
    turn();
}

// A part that cannot be flown lies right ahead, and the camera is pulled into it.
bool Submarine::startCarry()
{
    constexpr double kAhead_mm = 1, kNearPath_mm = 3;
    if (wantedPull() == 0)
        return false;
    const double direction = wantedPull() > 0 ? sign() : -sign();
    const double ahead = now_.station_mm + direction * kAhead_mm;
    if (ahead < first_mm_ || ahead > last_mm_ || wideAt(ahead) ||
        distance(now_.position_mm, path_->at(now_.station_mm).position_mm) > kNearPath_mm)
        return false;
    way_home_.clear();
    return now_.carried = true;
}

// Along the path, never nearer to the wall than the camera's radius or, where the path has less, than the path: what it
// was off the path fades first, then it goes on.
void Submarine::carry(double direction)
{
    const double onward = std::clamp(now_.station_mm + direction * kCruise_mm_s * kDt, first_mm_, last_mm_);
    const Vector3 off = now_.position_mm - path_->at(now_.station_mm).position_mm;
    const auto allowed = [&](double station, double share) {
        const Point3 on_path = path_->at(station).position_mm;
        return lumen_.clearance_mm(on_path + off * share) >= std::min(kCameraRadius_mm, lumen_.clearance_mm(on_path));
    };
    constexpr double kNothing_mm = 0.01;
    const auto shrunk = [&](double share) { return share * length(off) > kNothing_mm ? share : 0; };
    double share = shrunk(std::exp(-kBlend_per_s * kDt));
    const double station = allowed(onward, share) ? onward : now_.station_mm;
    while (share > 0 && !allowed(station, share))
        share = shrunk(share / 2);
    const PathFrame frame = path_->at(station);
    now_.velocity_mm_s = frame.forward * ((station - now_.station_mm) / kDt);
    now_.station_mm = station;
    now_.position_mm = frame.position_mm + off * share;
    if (wideAt(station) && space().holds(now_.position_mm))
        now_.carried = false;
}

Vector3 Submarine::wayOn() const
{
    return ahead_.direction(now_.station_mm, now_.position_mm, now_.heading);
}

Vector3 Submarine::exitSlope(int voxels) const
{
    Vector3 direction;
    const Grid& g = exit_.grid;
    const Index3 v = g.indexAt(now_.position_mm);
    const float here = exit_.valueOr(v, -1);
    for (int a = 0; a < 3 && here >= 0; ++a) {
        const Index3 step{voxels * (a == 0), voxels * (a == 1), voxels * (a == 2)};
        const float up = exit_.valueOr({v.i + step.i, v.j + step.j, v.k + step.k}, -1);
        const float down = exit_.valueOr({v.i - step.i, v.j - step.j, v.k - step.k}, -1);
        const double slope = ((up >= 0 ? up : here) - (down >= 0 ? down : here)) / ((up >= 0) + (down >= 0) + 1e-9);
        direction += g.axis[std::size_t(a)] * (slope / (voxels * g.spacing_mm[std::size_t(a)]));
    }
    return direction;
}

Vector3 Submarine::pull() const
{
    if (wantedPull() == 0)
        return {};
    const double towards_caecum = wantedPull() * sign();
    const double station = now_.station_mm + (towards_caecum > 0 ? 1 : -1);
    if (station < 0 || station > path_->length_mm())
        return {};
    const Vector3 direction = exitSlope(1);
    // The path's own direction keeps the pull from the field's steps between voxels, which would shake the picture.
    const Vector3 along = path_->at(now_.station_mm).forward;
    const Vector3 mixed = along * 2 + normalized(direction) * (dot(direction, along) > 0 ? 1 : 0);
    return normalized(mixed) * (towards_caecum * kCruise_mm_s * kFriction_per_s);
}

/// As strong as the field is steep, which is one millimetre to a millimetre of way.
Vector3 Submarine::drift() const
{
    constexpr double kArm_mm = 2.5;  // over less, the field's steps between voxels shake the picture
    const auto& spacing = exit_.grid.spacing_mm;
    const double voxel_mm = *std::min_element(spacing.begin(), spacing.end());
    Vector3 slope = exitSlope(std::max(1, int(std::lround(kArm_mm / voxel_mm))));
    if (const double steep = length(slope); steep > 1)
        slope = slope / steep;
    return slope * (steering_.drift * sign() * kCruise_mm_s * kFriction_per_s);
}

/// Not where the potentials hold it fast: before a fold the distance from the exit may grow into a pouch. Then the path
/// leads on until it has got farther.
bool Submarine::isAdrift()
{
    constexpr long kHeld_ticks = 240,
                   kLed_ticks = 360;  // a second without getting on; then half a second along the path
    constexpr double kGotOn_mm = 1;
    if (steering_.pull != 0 || steering_.drift == 0) {
        held_ticks_ = 0;
        farthest_mm_ = now_.station_mm;
        return false;
    }
    if ((now_.station_mm - farthest_mm_) * sign() * steering_.drift > kGotOn_mm) {
        farthest_mm_ = now_.station_mm;
        if (held_ticks_ < kHeld_ticks)
            held_ticks_ = 0;
    }
    if (++held_ticks_ > kHeld_ticks + kLed_ticks)
        held_ticks_ = 0;
    return held_ticks_ < kHeld_ticks;
}

Vector3 Submarine::pushOffWall() const
{
    const double reach = kWallShare * path_->at(now_.station_mm).radius_mm;
    const double wall = std::max(lumen_.clearance_mm(now_.position_mm), 0.5);
    if (wall >= reach)
        return {};
    const double slope = 2 * kWallStrength_mm2_s2 * (reach / wall - 1) * reach / (wall * wall);
    return lumen_.clearanceGradient(now_.position_mm) * slope;
}

void Submarine::move()
{
    const Vector3 right = cross(now_.forward, now_.up);
    const bool adrift = isAdrift();
    Vector3 force = adrift ? drift() : pull();
    if (steering_.thrusts())
        force +=
            (now_.forward * steering_.thrust_forward + right * steering_.thrust_right + now_.up * steering_.thrust_up) *
            (kThrust_mm_s * kFriction_per_s);
    const double speed_left = std::exp(-kFriction_per_s * kDt);
    now_.velocity_mm_s = now_.velocity_mm_s * speed_left + force * ((1 - speed_left) / kFriction_per_s);
    if (steering_.thrusts() || adrift) {
        now_.velocity_mm_s += pushOffWall() * kDt;
        way_home_.clear();
        adrift_ticks_ = 0;
    } else {
        home();
    }
    if (!steering_.thrusts() && !adrift && length(now_.velocity_mm_s) < kAtRest_mm_s)
        now_.velocity_mm_s = {};
    step();
    now_.station_mm = path_->nearestStation(now_.position_mm, now_.station_mm, kFootReach_mm);
}

// The camera stays where it fits.
void Submarine::step()
{
    now_.position_mm = space().moved(now_.position_mm, now_.velocity_mm_s, kDt);
}

void Submarine::turn()
{
    const Vector3 right = cross(now_.forward, now_.up);
    if (steering_.turns()) {
        const double rate = radians(kTurning_deg_s);
        const Vector3 wanted = right * (steering_.turn_up * rate) - now_.up * (steering_.turn_right * rate);
        now_.spin_rad_s += (wanted - now_.spin_rad_s) * (1 - std::exp(-kSteerRate_per_s * kDt));
    } else {
        const Vector3 forward = wayOn();
        const Vector3 up = uprightOn(forward, path_->at(now_.station_mm).up);
        const Vector3 error = rotationBetween(now_.forward, now_.up, forward, up);
        const double w = kRighting_per_s, fade = std::exp(-w * kDt);
        now_.spin_rad_s = (now_.spin_rad_s + (error * w - now_.spin_rad_s) * (w * kDt)) * fade;
        if (length(now_.spin_rad_s) < kAtRest_rad_s)
            now_.spin_rad_s = {};
    }
    now_.forward = normalized(rotated(now_.forward, now_.spin_rad_s * kDt));
    now_.up = uprightOn(now_.forward, rotated(now_.up, now_.spin_rad_s * kDt));
}

}  // namespace vicon::viewer
