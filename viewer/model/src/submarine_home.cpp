// The guided camera's way back to its path.
#include "free_space.h"
#include "vicon/viewer/model/submarine.h"

namespace vicon::viewer {
namespace {

constexpr double kHomeReach_mm = 40;  // how far along the path and around itself the camera looks
constexpr long kLookTicks = 6;        // how often it looks: forty times a second
constexpr double kArrived_mm = 0.3;

}  // namespace

// Straight to the foot, where that is free and wide enough; else straight to the nearest place of the path that is;
// else round what stands between.
void Submarine::lookForWayHome()
{
    const FreeSpace free = space();
    const Point3 here = now_.position_mm;
    const auto pathAt = [&](double station) { return path_->at(station).position_mm; };
    if (!way_home_.empty() && distance(here, pathAt(home_station_mm_)) < kArrived_mm)
        now_.station_mm = home_station_mm_;
    const bool was_round = way_home_.size() > 1;
    if (free.straightWay(here, pathAt(now_.station_mm))) {
        way_home_.clear();
        return;
    }
    std::vector<double> stations;
    for (double d = 1; d <= kHomeReach_mm; d += 1)
        for (const double s : {now_.station_mm + d * sign(), now_.station_mm - d * sign()}) {
            if (s < first_mm_ || s > last_mm_ || !wideAt(s))
                continue;
            stations.push_back(s);
            if (free.straightWay(here, pathAt(s))) {
                way_home_ = {pathAt(s)};
                home_station_mm_ = s;
                return;
            }
        }
    if (!was_round) {
        std::vector<Point3> goals;
        for (const double s : stations)
            goals.push_back(pathAt(s));
        const FreeSpace::Way way = free.wayTo(goals, here, kHomeReach_mm);
        way_home_ = way.found() ? way.places : std::vector<Point3>{pathAt(now_.station_mm)};
        home_station_mm_ = way.found() ? stations[way.goal] : now_.station_mm;
    }
    while (way_home_.size() > 1 && free.straightWay(here, way_home_[way_home_.size() - 2]))
        way_home_.pop_back();
}

// A critically damped spring, exact over the tick: across the path to the foot or, where there is no straight way, to
// the next place of the way home.
void Submarine::home()
{
    if (adrift_ticks_++ % kLookTicks == 0)
        lookForWayHome();
    const PathFrame foot = path_->at(now_.station_mm);
    const Point3 target = way_home_.empty() ? foot.position_mm : way_home_.back();
    const bool slides = way_home_.empty() && now_.station_mm > 0 && now_.station_mm < path_->length_mm();
    Vector3 off = now_.position_mm - target;
    if (slides)
        off = off - foot.forward * dot(off, foot.forward);
    const Vector3 along = slides ? foot.forward * dot(now_.velocity_mm_s, foot.forward) : Vector3{};
    const Vector3 across = now_.velocity_mm_s - along;
    const double w = kHoming_per_s, fade = std::exp(-w * kTick_s);
    const Vector3 mixed = across + off * w;
    now_.velocity_mm_s = along + (across - mixed * (w * kTick_s)) * fade;
}

}  // namespace vicon::viewer
