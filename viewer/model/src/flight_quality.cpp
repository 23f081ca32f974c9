#include "vicon/viewer/model/flight_quality.h"

#include <algorithm>
#include <cmath>

#include "vicon/viewer/model/peeling.h"

namespace vicon::viewer {
namespace {

constexpr double kFarRadii = 4, kLeastFar_mm = 30, kMostFar_mm = 80;
constexpr double kStep_mm = 2;
constexpr double kJump_mm = 15;  // between two frames: more is a stretch that is left out

Point3 wayOn(const ViewPose& view, double sign, const PathFrames& path, const Lumen& lumen)
{
    const PathFrame here = path.at(view.station_mm);
    const double most_mm = std::clamp(kFarRadii * here.radius_mm, kLeastFar_mm, kMostFar_mm);
    Point3 farthest = view.pose.eye_mm + here.forward * sign;
    for (double ahead_mm = 2 * kStep_mm; ahead_mm <= most_mm; ahead_mm += kStep_mm) {
        const double station = view.station_mm + sign * ahead_mm;
        if (station < 0 || station > path.length_mm())
            break;
        const PathFrame there = path.at(station);
        if (there.on_bridge || !lumen.sees(view.pose.eye_mm, there.position_mm))
            break;
        farthest = there.position_mm;
    }
    return farthest;
}

bool inMiddleHalf(const Pose& pose, const Lens& lens, Point3 point)
{
    const Projected seen = project(pose, lens, point);
    return seen.depth_mm > 0 && std::abs(seen.at.x - lens.width / 2.0) <= lens.width / 4.0 &&
           std::abs(seen.at.y - lens.height / 2.0) <= lens.height / 4.0;
}

double angle_deg(Vector3 a, Vector3 b)
{
    return std::acos(std::clamp(dot(a, b), -1.0, 1.0)) / radians(1);
}

double share(std::vector<double>& values, double part)
{
    if (values.empty())
        return 0;
    const auto at = values.begin() + std::ptrdiff_t(double(values.size() - 1) * part);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

}  // namespace

FlightQuality qualityOf(const std::vector<ViewPose>& poses, Heading heading, const PathFrames& path, const Lumen& lumen,
                        const Lens& lens)
{
    const double sign = heading == Heading::caecum ? 1 : -1;
    FlightQuality quality;
    std::vector<double> turns, rolls;
    for (std::size_t n = 0; n < poses.size(); ++n) {
        const ViewPose& view = poses[n];
        const double radius_mm = path.at(view.station_mm).radius_mm;
        quality.way_on_central += inMiddleHalf(view.pose, lens, wayOn(view, sign, path, lumen));
        const auto wall_mm = distanceToWall_mm(lumen, view.pose.eye_mm, view.pose.forward, radius_mm);
        quality.wall_close += wall_mm && *wall_mm < radius_mm;
        const double moved_mm = n > 0 ? std::abs(view.station_mm - poses[n - 1].station_mm) : 0;
        if (moved_mm <= 0 || moved_mm > kJump_mm)
            continue;
        const Pose& before = poses[n - 1].pose;
        turns.push_back(angle_deg(view.pose.forward, before.forward) / moved_mm);
        rolls.push_back(angle_deg(uprightOn(view.pose.forward, before.up), view.pose.up) / moved_mm);
    }
    if (2 * turns.size() < poses.size()) {
        turns.clear();  // the few that are there would speak for all
        rolls.clear();
    }
    const double count = std::max<double>(1, double(poses.size()));
    quality.way_on_central /= count;
    quality.wall_close /= count;
    quality.turn_median_deg_mm = share(turns, 0.5);
    quality.turn_slow_deg_mm = share(turns, 0.99);
    quality.roll_median_deg_mm = share(rolls, 0.5);
    return quality;
}

}  // namespace vicon::viewer
