#include "vicon/viewer/model/look_ahead.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vicon/viewer/model/peeling.h"

namespace vicon::viewer {
namespace {

constexpr double kNode_mm = 2;       // distance of the places from which sights are taken
constexpr double kFirstLook_mm = 4;  // what is nearer says nothing about the way
constexpr double kReach = 2.5;       // of the smoothing, in sigmas
constexpr int kRings = 3, kRaysARing = 12;
// Chosen on bent tubes of 8 to 25 mm radius with folds and on a real prone scan: the way on is looked at so many of the
// lumen's radii ahead, within these bounds; around it, what is open draws the view to itself; and it is smoothed along
// the path (sigma), so that a fold that is passed does not jerk the view.
constexpr double kAheadRadii = 4, kLeastAhead_mm = 30, kMostAhead_mm = 80;
constexpr double kOpen_deg = 45, kSmoothing_mm = 8;

}  // namespace

LookAhead::LookAhead(const PathFrames& path, const Lumen& lumen) : path_(&path), lumen_(lumen)
{
    for (auto& nodes : nodes_)
        nodes.resize(std::size_t(path.length_mm() / kNode_mm) + 2);
}

double LookAhead::farthest_mm(const PathFrame& here) const
{
    return std::clamp(kAheadRadii * here.radius_mm, kLeastAhead_mm, kMostAhead_mm);
}

double LookAhead::sightFrom(const PathFrame& here, double station_mm, double sign) const
{
    if (here.on_bridge || !lumen_.inside(here.position_mm))
        return 0;
    const double most_mm = farthest_mm(here);
    const double step_mm = std::clamp(here.radius_mm / 4, 2.0, 5.0);
    double seen_mm = 0;
    for (double ahead_mm = kFirstLook_mm; ahead_mm <= most_mm; ahead_mm += step_mm) {
        const double station = station_mm + sign * ahead_mm;
        if (station < 0 || station > path_->length_mm())
            break;
        const PathFrame there = path_->at(station);
        if (there.on_bridge || !lumen_.sees(here.position_mm, there.position_mm))
            break;
        seen_mm = ahead_mm;
    }
    return seen_mm;
}

// The mean of the ways around it, by how far each is free; squared, for that is how much lumen lies there.
Vector3 LookAhead::openFrom(const PathFrame& here, Vector3 way) const
{
    const double most_mm = farthest_mm(here);
    const Vector3 right = cross(way, here.up), up = cross(right, way);
    const auto weighted = [&](Vector3 ray) {
        const double free_mm = distanceToWall_mm(lumen_, here.position_mm, ray, most_mm).value_or(most_mm);
        return ray * (free_mm * free_mm);
    };
    Vector3 sum = weighted(way);
    for (int ring = 1; ring <= kRings; ++ring)
        for (int n = 0; n < kRaysARing; ++n) {
            const double off = radians(kOpen_deg) * ring / kRings;
            const double turn = 2 * std::numbers::pi * n / kRaysARing;
            const Vector3 aside = right * std::cos(turn) + up * std::sin(turn);
            sum += weighted(way * std::cos(off) + aside * std::sin(off));
        }
    return length(sum) > 0 ? normalized(sum) : way;
}

LookAhead::Node LookAhead::lookFrom(double station_mm, double sign) const
{
    const PathFrame here = path_->at(station_mm);
    const double sight_mm = sightFrom(here, station_mm, sign);
    if (sight_mm == 0)
        return {here.forward * sign, 0};  // where nothing is in view the path itself leads on
    const Vector3 way = normalized(path_->at(station_mm + sign * sight_mm).position_mm - here.position_mm);
    return {openFrom(here, way), sight_mm};
}

const LookAhead::Node& LookAhead::nodeAt(int node, Heading heading) const
{
    std::vector<Node>& nodes = nodes_[heading == Heading::caecum ? 0 : 1];
    Node& known = nodes[std::size_t(std::clamp(node, 0, int(nodes.size()) - 1))];
    if (length(known.way) == 0)
        known = lookFrom(std::min(node * kNode_mm, path_->length_mm()), heading == Heading::caecum ? 1 : -1);
    return known;
}

double LookAhead::sight_mm(double station_mm, Heading heading) const
{
    return nodeAt(int(std::lround(station_mm / kNode_mm)), heading).sight_mm;
}

double LookAhead::turn_rad_mm(double station_mm, Heading heading) const
{
    const auto look = [&](double station) { return direction(station, path_->at(station).position_mm, heading); };
    const double before = std::max(0.0, station_mm - kNode_mm / 2);
    const double after = std::min(path_->length_mm(), station_mm + kNode_mm / 2);
    return after > before ? std::acos(std::clamp(dot(look(before), look(after)), -1.0, 1.0)) / (after - before) : 0;
}

Vector3 LookAhead::direction(double station_mm, Point3 eye_mm, Heading heading) const
{
    const double reach_mm = kReach * kSmoothing_mm;
    const int first = std::max(0, int(std::ceil((station_mm - reach_mm) / kNode_mm)));
    const int last = int(std::floor(std::min(station_mm + reach_mm, path_->length_mm()) / kNode_mm));
    Vector3 ways;
    double sights = 0, weights = 0;
    for (int n = first; n <= last; ++n) {
        const double off = (n * kNode_mm - station_mm) / kSmoothing_mm, weight = std::exp(-off * off / 2);
        const Node& node = nodeAt(n, heading);
        ways += node.way * weight;
        sights += node.sight_mm * weight;
        weights += weight;
    }
    const PathFrame here = path_->at(station_mm);
    if (length(ways) == 0)
        return here.forward * (heading == Heading::caecum ? 1 : -1);
    // An eye beside the path looks at the same place.
    const double far_mm = std::max(sights / weights, kFirstLook_mm);
    return normalized(here.position_mm + normalized(ways) * far_mm - eye_mm);
}

}  // namespace vicon::viewer
