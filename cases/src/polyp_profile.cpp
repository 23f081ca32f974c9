#include "polyp_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vicon {
namespace {

// Chosen on synthetic half balls, ellipsoids and balls on stalks of 4 to 30 mm, on flat and bent walls.
constexpr double kSmoothing_mm = 0.6;  // of a section's direction: below what a scan shows
constexpr double kSteep = -0.2;        // a polyp's side: the direction at its steepest, in radians
constexpr double kConcave = 0.02;      // per mm: what bends less is wall
constexpr double kSharp = 0.15;        // per mm: a rim also where the wall rises behind it, in a narrow colon
/// What comes behind a bend that fell below this part of the sharpest so far is not the rim.
constexpr double kPast = 0.5;
/// The same under an overhang, which ends at a stalk; its foot on the wall is the next bend.
constexpr double kPastOverhang = 0.85, kOverhang = -1.9;

void smoothAngles(std::vector<double>& values, double sigma_steps)
{
    const int reach = int(std::ceil(2.5 * sigma_steps)), n = int(values.size());
    std::vector<double> even(values.size());
    for (int i = 0; i < n; ++i) {
        double sum = 0, weights = 0;
        for (int d = -reach; d <= reach; ++d) {
            const double weight = std::exp(-d * d / (2 * sigma_steps * sigma_steps));
            sum += weight * values[std::size_t(std::clamp(i + d, 0, n - 1))];
            weights += weight;
        }
        even[std::size_t(i)] = sum / weights;
    }
    values = std::move(even);
}

}  // namespace

PolypProfile polypProfileOf(const std::vector<Point3>& line, Point3 top, Vector3 axis, Vector3 out)
{
    PolypProfile profile;
    double left = 0;
    for (std::size_t n = 1; n < line.size(); ++n) {
        const double step = distance(line[n - 1], line[n]);
        for (; left < step; left += PolypProfile::kStep_mm) {
            const Point3 p = interpolate(line[n - 1], line[n], left / step);
            profile.points.push_back(p);
            profile.out_mm.push_back(dot(p - top, out));
            profile.up_mm.push_back(dot(p - top, axis));
        }
        left -= step;
    }
    const std::size_t count = profile.points.size();
    for (std::size_t n = 0; n + 1 < count; ++n) {
        double angle = std::atan2(profile.up_mm[n + 1] - profile.up_mm[n], profile.out_mm[n + 1] - profile.out_mm[n]);
        if (n > 0)  // no jump over the cut from pi to -pi
            angle += 2 * std::numbers::pi * std::round((profile.turned.back() - angle) / (2 * std::numbers::pi));
        profile.turned.push_back(angle);
    }
    if (profile.turned.size() < 3)
        return profile;
    smoothAngles(profile.turned, kSmoothing_mm / PolypProfile::kStep_mm);
    for (std::size_t n = 0; n + 1 < profile.turned.size(); ++n)
        profile.bend.push_back((profile.turned[n + 1] - profile.turned[n]) / PolypProfile::kStep_mm);
    return profile;
}

std::optional<std::size_t> rimOf(const PolypProfile& profile)
{
    double sharpest = kConcave;
    std::optional<std::size_t> rim;
    double lowest = 0;
    for (std::size_t n = 0; n < profile.bend.size(); ++n) {
        lowest = std::min(lowest, profile.turned[n]);
        if (lowest > kSteep && profile.bend[n] < kSharp && !rim)
            continue;
        if (profile.bend[n] > sharpest) {
            sharpest = profile.bend[n];
            rim = n;
        } else if (rim && profile.bend[n] < (lowest < kOverhang ? kPastOverhang : kPast) * sharpest) {
            break;
        }
    }
    return rim;
}

bool headHolds(const PolypProfile& profile, std::size_t rim, double base_mm, double out_mm, double up_mm,
               double beside_mm)
{
    std::vector<std::array<double, 2>> edge{{0, base_mm}, {0, profile.up_mm.front()}};
    for (std::size_t n = 0; n <= rim; ++n)
        edge.push_back({profile.out_mm[n], profile.up_mm[n]});
    bool inside = false;
    double nearest_mm = std::hypot(out_mm - edge.front()[0], up_mm - edge.front()[1]);
    for (std::size_t n = 0; n < edge.size(); ++n) {
        const auto [x0, y0] = edge[n];
        const auto [x1, y1] = edge[(n + 1) % edge.size()];
        const double x = x1 - x0, y = y1 - y0, squared = x * x + y * y;
        const double along = squared > 0 ? std::clamp(((out_mm - x0) * x + (up_mm - y0) * y) / squared, 0.0, 1.0) : 0.0;
        nearest_mm = std::min(nearest_mm, std::hypot(out_mm - x0 - along * x, up_mm - y0 - along * y));
        if ((y0 > up_mm) != (y1 > up_mm) && out_mm < x0 + (up_mm - y0) / y * x)
            inside = !inside;
    }
    return inside || nearest_mm <= beside_mm;
}

}  // namespace vicon
