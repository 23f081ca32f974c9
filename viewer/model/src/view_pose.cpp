#include "vicon/viewer/model/view_pose.h"

#include <algorithm>
#include <optional>

#include "vicon/core/error.h"

namespace vicon::viewer {
namespace {

constexpr double kLookStep_mm = 1;
// Wanted distance over the lumen's radius: folds lie in front, the point is not grazed. Chosen as kCameraRadius_mm.
constexpr double kDistancePerRadius = 1.7;
constexpr double kAnchorReach_mm = 15;    // a marker lies at most this far from the lumen: large polyps' middles
constexpr double kSightSlack_mm = 1.5;    // about a voxel: the wall's own blur before a point on it
constexpr double kFromBehindCost = 0.35;  // of the wanted distance: looking back towards the rectum is second choice
constexpr double kGrazingCosine = 0.35;   // below it a wall is seen too flat

struct Scene {
    const PathFrames& path;
    const Lumen& lumen;
};

/// What the eye keeps from the wall where the path is at a station; `room_mm` where nothing is narrow.
double roomAt(const Scene& scene, double station_mm, double room_mm)
{
    constexpr double kOfRadius = 0.5;
    return scene.path.tapers() ? std::min(room_mm, kOfRadius * scene.path.at(station_mm).radius_mm) : room_mm;
}

// Up the clearance by small steps, until it suffices or no longer grows.
Point3 moreRoom(const Lumen& lumen, Point3 p, double enough_mm)
{
    constexpr double kClimb_mm = 0.5;
    constexpr int kMost = 40;
    for (int n = 0; n < kMost && lumen.clearance_mm(p) < enough_mm; ++n) {
        const Point3 next = p + normalized(lumen.clearanceGradient(p)) * kClimb_mm;
        if (!lumen.inside(next) || lumen.clearance_mm(next) <= lumen.clearance_mm(p))
            break;
        p = next;
    }
    return p;
}

std::optional<Point3> eyeAt(const Scene& scene, double station_mm, double room_mm)
{
    const PathFrame frame = scene.path.at(station_mm);
    if (frame.on_bridge || !scene.lumen.inside(frame.position_mm))
        return {};
    const Point3 eye = moreRoom(scene.lumen, frame.position_mm, room_mm);
    if (scene.lumen.clearance_mm(eye) < room_mm)
        return {};
    return eye;
}

struct Place {
    double station_mm;
    Point3 eye_mm;
};

Place nearestPlace(const Scene& scene, double station_mm)
{
    const double length = scene.path.length_mm();
    const double at = std::clamp(station_mm, 0.0, length);
    constexpr double kNear_mm = 40;  // further off, a narrow place at hand is better than a wide one
    const std::pair<double, double> tries[] = {{kCameraRadius_mm, kNear_mm}, {scene.lumen.halfDiagonal_mm(), length}};
    for (const auto& [room, reach] : tries)
        for (double d = 0; d <= reach; d += kLookStep_mm)
            for (const double station : {at - d, at + d})
                if (station >= 0 && station <= length)
                    if (const auto eye = eyeAt(scene, station, roomAt(scene, station, room)))
                        return {station, *eye};
    throw Error(ErrorCode::unusable_scan, "no part of the centreline lies in the lumen", {},
                "run 'vicon work' to prepare the scan anew");
}

// A point to look at: where it is, where the lumen before it is, and where its wall faces.
struct Target {
    Point3 point_mm, anchor_mm;
    double allowance_mm = 0;
    Vector3 facing;
};

Target targetAt(const Lumen& lumen, Point3 point)
{
    const Lumen::Nearest nearest = lumen.nearestInside(point, kAnchorReach_mm);
    Target target{point, nearest.position_mm, 1.5 * nearest.distance_mm + kSightSlack_mm, {}};
    if (!nearest.found)
        target.anchor_mm = point;
    const Point3 room = moreRoom(lumen, target.anchor_mm, 4);
    target.facing = normalized(room == target.anchor_mm ? lumen.clearanceGradient(room) : room - point);
    return target;
}

struct Candidate {
    Place place;
    double distance_mm;
};

void consider(std::vector<Candidate>& candidates, const Scene& scene, const Target& target, Place place)
{
    const double d = distance(place.eye_mm, target.point_mm);
    if (d < kLeastDistance_mm / 2 || d > 1.3 * kMostDistance_mm)
        return;
    if (scene.lumen.clearance_mm(place.eye_mm) < roomAt(scene, place.station_mm, kCameraRadius_mm) ||
        !scene.lumen.inside(place.eye_mm))
        return;
    if (scene.lumen.sees(place.eye_mm, target.point_mm, target.allowance_mm))
        candidates.push_back({place, d});
}

std::vector<Candidate> onPath(const Scene& scene, const Target& target)
{
    std::vector<Candidate> candidates;
    for (double s = 0; s <= scene.path.length_mm(); s += kLookStep_mm)
        if (const PathFrame frame = scene.path.at(s); !frame.on_bridge)
            consider(candidates, scene, target, {s, frame.position_mm});
    return candidates;
}

std::vector<Candidate> besidePath(const Scene& scene, const Target& target)
{
    std::vector<Candidate> candidates;
    for (double s = 0; s <= scene.path.length_mm(); s += 2 * kLookStep_mm) {
        const PathFrame frame = scene.path.at(s);
        if (frame.on_bridge || distance(frame.position_mm, target.point_mm) > 2 * kMostDistance_mm)
            continue;
        const Vector3 right = cross(frame.forward, frame.up);
        for (const double share : {0.3, 0.55, 0.75})
            for (int turn = 0; turn < 12; ++turn) {
                const double a = turn * std::numbers::pi / 6;
                const Vector3 aside = right * std::cos(a) + frame.up * std::sin(a);
                const Point3 eye = frame.position_mm + aside * (share * frame.radius_mm);
                if (scene.lumen.sees(frame.position_mm, eye))
                    consider(candidates, scene, target, {s, eye});
            }
    }
    return candidates;
}

const Candidate& bestOf(const std::vector<Candidate>& candidates, const Scene& scene, const Target& target)
{
    const auto nearest = std::min_element(candidates.begin(), candidates.end(),
                                          [](const auto& a, const auto& b) { return a.distance_mm < b.distance_mm; });
    const double foot = nearest->place.station_mm;
    const double wanted =
        std::clamp(kDistancePerRadius * scene.path.at(foot).radius_mm, kLeastDistance_mm, kMostDistance_mm);
    const auto cost = [&](const Candidate& c) {
        const double cosine = dot(normalized(c.place.eye_mm - target.point_mm), target.facing);
        return std::abs(c.distance_mm - wanted) / wanted + (c.place.station_mm > foot ? kFromBehindCost : 0) +
               2 * std::max(0.0, kGrazingCosine - cosine);
    };
    return *std::min_element(candidates.begin(), candidates.end(),
                             [&](const auto& a, const auto& b) { return cost(a) < cost(b); });
}

// Straight up from the wall at the point, as far as the point stays in view.
std::optional<Point3> aboveWall(const Scene& scene, const Target& target)
{
    constexpr double kClimb_mm = 0.5;
    Point3 p = target.anchor_mm;
    std::optional<Point3> best;
    while (distance(p, target.point_mm) < kLeastDistance_mm) {
        const Point3 next = p + normalized(scene.lumen.clearanceGradient(p)) * kClimb_mm;
        if (!scene.lumen.inside(next) || scene.lumen.clearance_mm(next) <= scene.lumen.clearance_mm(p))
            break;
        p = next;
        const bool roomy = scene.lumen.clearance_mm(p) >= kCameraRadius_mm;
        if (roomy && scene.lumen.sees(p, target.point_mm, target.allowance_mm))
            best = p;
    }
    return best;
}

ViewPose viewOf(const Scene& scene, const Place& place, Point3 point, bool sees)
{
    const Vector3 up = scene.path.at(place.station_mm).up;
    return {lookAt(place.eye_mm, point, up), place.station_mm, scene.lumen.clearance_mm(place.eye_mm), sees};
}

}  // namespace

ViewPose poseAtStation(const PathFrames& path, const Lumen& lumen, const LookAhead& ahead, double station_mm,
                       Heading heading)
{
    const Place place = nearestPlace({path, lumen}, station_mm);
    const Vector3 forward = ahead.direction(place.station_mm, place.eye_mm, heading);
    const Pose pose{place.eye_mm, forward, uprightOn(forward, path.at(place.station_mm).up)};
    return {pose, place.station_mm, lumen.clearance_mm(place.eye_mm), true};
}

ViewPose poseAtStation(const PathFrames& path, const Lumen& lumen, double station_mm, Heading heading)
{
    return poseAtStation(path, lumen, LookAhead(path, lumen), station_mm, heading);
}

ViewPose poseForPoint(const Skeleton& skeleton, const PathFrames& path, const Lumen& lumen, Point3 point_mm)
{
    const Scene scene{path, lumen};
    const Target target = targetAt(lumen, point_mm);
    auto candidates = onPath(scene, target);
    if (candidates.empty())
        candidates = besidePath(scene, target);
    if (!candidates.empty())
        return viewOf(scene, bestOf(candidates, scene, target).place, point_mm, true);
    const double station = skeleton.nearest(target.anchor_mm).station_mm;
    if (const auto eye = aboveWall(scene, target))
        return viewOf(scene, {station, *eye}, point_mm, true);
    return viewOf(scene, nearestPlace(scene, station), point_mm, false);
}

}  // namespace vicon::viewer
