#include "vicon/viewer/model/submarine.h"

#include <algorithm>

#include "rotation.h"
#include "vicon/core/error.h"

namespace vicon::viewer {
namespace {

constexpr double kDt = Submarine::kTick_s;
constexpr double kFootReach_mm = 8;     // how far a foot moves in a tick at most, with room for folded paths
constexpr double kSpare_mm = 0.3;       // a station counts as wide when it leaves this beside the camera
constexpr double kHomeReach_mm = 40;    // how far along the path a camera behind a fold looks for its way back
constexpr long kHomeTicks = 24;         // how often it looks: ten times a second
constexpr double kSteerRate_per_s = 8;  // how fast turning follows the hand

}  // namespace

Submarine::Submarine(const PathFrames& path, const Lumen& lumen, const FieldVolume& exit_distance,
                     const SubmarineOptions& options)
    : path_(&path), lumen_(lumen), exit_(&exit_distance), options_(options)
{
    placeAt(0, Heading::caecum);
}

// The field of a voxel may promise half a diagonal more than there is.
bool Submarine::fits(Point3 p) const
{
    return lumen_.inside(p) && lumen_.clearance_mm(p) >= options_.camera_radius_mm + lumen_.halfDiagonal_mm();
}

bool Submarine::wideAt(double station_mm) const
{
    const PathFrame frame = path_->at(station_mm);
    return !frame.on_bridge && fits(frame.position_mm) &&
           lumen_.clearance_mm(frame.position_mm) >= options_.camera_radius_mm + lumen_.halfDiagonal_mm() + kSpare_mm;
}

void Submarine::placeAt(double station_mm, Heading heading)
{
    const double length = path_->length_mm();
    const double wanted = std::clamp(station_mm, 0.0, length);
    for (double d = 0; d <= length; d += 0.5)
        for (const double station : {wanted - d, wanted + d})
            if (station >= 0 && station <= length && wideAt(station)) {
                const PathFrame frame = path_->at(station);
                now_ = {frame.position_mm, {}, {}, {}, frame.up, station, false, heading};
                now_.forward = frame.forward * sign();
                before_ = now_;
                foot_in_sight_ = true;
                owed_s_ = 0;
                return;
            }
    throw Error(ErrorCode::unusable_scan, "no part of the skeleton is wide enough for the camera", {},
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
    const double rest = sign() > 0 ? path_->length_mm() - now_.station_mm : now_.station_mm;
    double wide_ahead = 0;  // what is left may be too narrow to be flown
    for (double d = 0.5; d <= rest && wide_ahead == 0; d += 0.5)
        if (wideAt(now_.station_mm + sign() * d))
            wide_ahead = d > kEnd_mm ? d : 0;
    s.at_end = rest <= kEnd_mm || wide_ahead == 0;
    return s;
}

void Submarine::tick()
{
    ++ticks_;
    if (now_.carried || startCarry()) {
        carry(steering_.pull < 0 ? -sign() : sign());
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
    if (steering_.pull == 0)
        return false;
    const double direction = steering_.pull > 0 ? sign() : -sign();
    const double ahead = now_.station_mm + direction * kAhead_mm;
    if (ahead < 0 || ahead > path_->length_mm() || wideAt(ahead) ||
        distance(now_.position_mm, path_->at(now_.station_mm).position_mm) > kNearPath_mm)
        return false;
    for (double s = ahead; s >= 0 && s <= path_->length_mm(); s += direction * 0.5)
        if (wideAt(s))
            return now_.carried = true;
    return false;  // nothing wide beyond: this is the end
}

void Submarine::carry(double direction)
{
    const double station =
        std::clamp(now_.station_mm + direction * options_.cruise_mm_s * kDt, 0.0, path_->length_mm());
    const PathFrame frame = path_->at(station);
    now_.velocity_mm_s = frame.forward * (direction * options_.cruise_mm_s);
    now_.station_mm = station;
    foot_in_sight_ = true;
    // From wherever it was, onto the path within a few ticks.
    const Vector3 off = now_.position_mm - path_->at(now_.station_mm).position_mm;
    now_.position_mm = frame.position_mm + off * std::exp(-20 * kDt);
    if (wideAt(station) && fits(now_.position_mm))
        now_.carried = false;
}

Vector3 Submarine::pull() const
{
    if (steering_.pull == 0)
        return {};
    const double towards_caecum = steering_.pull * sign();
    const double station = now_.station_mm + (towards_caecum > 0 ? 1 : -1);
    if (station < 0 || station > path_->length_mm())
        return {};
    Vector3 direction;  // along which the distance from the exit grows, of inside voxels only
    const Grid& g = exit_->grid;
    const Index3 v = g.indexAt(now_.position_mm);
    const float here = exit_->valueOr(v, -1);
    for (int a = 0; a < 3 && here >= 0; ++a) {
        const Index3 step{a == 0, a == 1, a == 2};
        const float up = exit_->valueOr({v.i + step.i, v.j + step.j, v.k + step.k}, -1);
        const float down = exit_->valueOr({v.i - step.i, v.j - step.j, v.k - step.k}, -1);
        const double slope = ((up >= 0 ? up : here) - (down >= 0 ? down : here)) / ((up >= 0) + (down >= 0) + 1e-9);
        direction += g.axis[std::size_t(a)] * (slope / g.spacing_mm[std::size_t(a)]);
    }
    // The path's own direction keeps the pull from the field's steps between voxels, which would shake the picture.
    const Vector3 along = path_->at(now_.station_mm).forward;
    const Vector3 mixed = along * 2 + normalized(direction) * (dot(direction, along) > 0 ? 1 : 0);
    return normalized(mixed) * (towards_caecum * options_.cruise_mm_s * options_.friction_per_s);
}

Vector3 Submarine::pushOffWall() const
{
    const double reach = options_.wall_share * path_->at(now_.station_mm).radius_mm;
    const double wall = std::max(lumen_.clearance_mm(now_.position_mm), 0.5);
    if (wall >= reach)
        return {};
    const double slope = 2 * options_.wall_strength_mm2_s2 * (reach / wall - 1) * reach / (wall * wall);
    return lumen_.clearanceGradient(now_.position_mm) * slope;
}

void Submarine::lookForPath(Point3 foot)
{
    foot_in_sight_ = lumen_.sees(now_.position_mm, foot);
    home_station_mm_ = now_.station_mm;
    for (double d = 1; d <= kHomeReach_mm && !foot_in_sight_; d += 1)
        for (const double s : {now_.station_mm + d, now_.station_mm - d})
            if (s >= 0 && s <= path_->length_mm() && lumen_.sees(now_.position_mm, path_->at(s).position_mm)) {
                home_station_mm_ = s;
                return;
            }
}

// A critically damped spring across the path, exact over the tick, to the foot or, behind a fold, to the nearest place
// of the path in sight.
void Submarine::home()
{
    const PathFrame foot = path_->at(now_.station_mm);
    if (ticks_ % kHomeTicks == 0)
        lookForPath(foot.position_mm);
    const Point3 target = foot_in_sight_ ? foot.position_mm : path_->at(home_station_mm_).position_mm;
    const bool slides = foot_in_sight_ && now_.station_mm > 0 && now_.station_mm < path_->length_mm();
    Vector3 off = now_.position_mm - target;
    if (slides)
        off = off - foot.forward * dot(off, foot.forward);
    const Vector3 along = slides ? foot.forward * dot(now_.velocity_mm_s, foot.forward) : Vector3{};
    const Vector3 across = now_.velocity_mm_s - along;
    const double w = options_.homing_per_s, fade = std::exp(-w * kDt);
    const Vector3 mixed = across + off * w;
    now_.velocity_mm_s = along + (across - mixed * (w * kDt)) * fade;
}

void Submarine::move()
{
    const Vector3 right = cross(now_.forward, now_.up);
    Vector3 force = pull();
    if (steering_.thrusts())
        force +=
            (now_.forward * steering_.thrust_forward + right * steering_.thrust_right + now_.up * steering_.thrust_up) *
            (options_.thrust_mm_s * options_.friction_per_s);
    const double speed_left = std::exp(-options_.friction_per_s * kDt);
    now_.velocity_mm_s = now_.velocity_mm_s * speed_left + force * ((1 - speed_left) / options_.friction_per_s);
    if (steering_.thrusts())
        now_.velocity_mm_s += pushOffWall() * kDt;
    else
        home();
    step();
    now_.station_mm = path_->nearestStation(now_.position_mm, now_.station_mm, kFootReach_mm);
}

// The camera stays where it fits. Where a step would leave, it slides along the wall; where that would, it stays.
void Submarine::step()
{
    constexpr double kMostStep_mm = 0.5;
    Vector3 move = now_.velocity_mm_s * kDt;
    if (length(move) > kMostStep_mm)
        move = normalized(move) * kMostStep_mm;
    if (fits(now_.position_mm + move)) {
        now_.position_mm += move;
        return;
    }
    const Vector3 off_wall = normalized(lumen_.clearanceGradient(now_.position_mm));
    const auto slid = [&](Vector3 v) { return v - off_wall * std::min(0.0, dot(v, off_wall)); };
    const double least = options_.camera_radius_mm + lumen_.halfDiagonal_mm();
    Point3 next = now_.position_mm + slid(move);
    next += off_wall * std::max(0.0, least + 1e-3 - lumen_.clearance_mm(next));
    if (fits(next) && distance(next, now_.position_mm) <= 2 * kMostStep_mm)
        now_.position_mm = next;
    now_.velocity_mm_s = slid(now_.velocity_mm_s);
}

void Submarine::turn()
{
    const Vector3 right = cross(now_.forward, now_.up);
    if (steering_.turns()) {
        const double rate = radians(options_.turning_deg_s);
        const Vector3 wanted = right * (steering_.turn_up * rate) - now_.up * (steering_.turn_right * rate);
        now_.spin_rad_s += (wanted - now_.spin_rad_s) * (1 - std::exp(-kSteerRate_per_s * kDt));
    } else {
        const PathFrame frame = path_->at(now_.station_mm + sign() * options_.look_ahead_mm);
        const Vector3 forward = frame.forward * sign();
        const Vector3 error = rotationBetween(now_.forward, now_.up, forward, uprightOn(forward, frame.up));
        const double w = options_.righting_per_s, fade = std::exp(-w * kDt);
        now_.spin_rad_s = (now_.spin_rad_s + (error * w - now_.spin_rad_s) * (w * kDt)) * fade;
    }
    now_.forward = normalized(rotated(now_.forward, now_.spin_rad_s * kDt));
    now_.up = uprightOn(now_.forward, rotated(now_.up, now_.spin_rad_s * kDt));
}

}  // namespace vicon::viewer
