#include "skeleton/unwind.h"

#include <algorithm>
#include <cmath>

namespace vicon::steps {
namespace {

// Chosen on the four shapes of the reference data, of which HuBMAPVHM_3D_00070 needs it: with 0.95 and 1 times the
// path's length the curve follows its sharpest bend with given and with found ends and with either of two smoothings,
// with 1.1 it depends on them.
constexpr double kLeastOn = 0.5;   // of a step along the line that must be left once its ends were moved
constexpr double kMostTurn = 1.4;  // rad, within a radius on either side; a bend as sharp as the lumen is wide has 1
constexpr double kWound = 1.0;     // times the path's length: what is longer than that has wound itself up
constexpr double kFromEnds = 4;    // radii; nearer to an end too little tells how far aside of the path the line is
constexpr double kSearch_mm = 40;  // ahead along the path, for the next point's foot on it

/// Points of a line, both included.
struct Crossing {
    std::size_t from = 0, to = 0;
};

/// Angle by which a line turns within a reach on either side of one of its points.
double turnAt(const Polyline& line, std::size_t n, std::size_t reach)
{
    if (reach < 1 || n < reach || n + reach >= line.size())
        return 0;
    const double along = dot(normalized(line[n] - line[n - reach]), normalized(line[n + reach] - line[n]));
    return std::acos(std::clamp(along, -1.0, 1.0));
}

/// The stretches in which sections cross or the moved line turns on the spot, with a radius of the lumen on either
/// side.
std::vector<Crossing> crossings(const Polyline& line, const Polyline& moved, const DistanceProbe& wall, double step_mm)
{
    std::vector<Crossing> all;
    for (std::size_t n = 0; n + 1 < line.size(); ++n) {
        const Vector3 step = line[n + 1] - line[n];
        const bool goes_on = dot(moved[n + 1] - moved[n], step) >= kLeastOn * dot(step, step);
        if (goes_on && turnAt(moved, n, std::size_t(wall.at(moved[n]) / step_mm)) < kMostTurn)
            continue;
        const auto around = std::size_t(wall.at(line[n]) / step_mm) + 1;
        const auto away = std::size_t(kFromEnds * double(around));
        if (n < away || n + 1 + away >= line.size())
            continue;
        const Crossing own{n - around, n + 1 + around};
        if (all.empty() || own.from > all.back().to)
            all.push_back(own);
        else
            all.back() = {std::min(all.back().from, own.from), std::max(all.back().to, own.to)};
    }
    return all;
}

/// Number of the point of the path that lies beside each point of the line, in order.
std::vector<std::size_t> feetOn(const Polyline& path, const Polyline& line, double step_mm)
{
    const auto ahead = std::size_t(kSearch_mm / step_mm) + 1;
    std::vector<std::size_t> feet(line.size());
    auto foot = path.begin();
    for (std::size_t n = 0; n < line.size(); ++n) {
        const auto nearer = [&](Point3 a, Point3 b) { return distance(a, line[n]) < distance(b, line[n]); };
        const auto left = std::size_t(path.end() - foot);
        foot = std::min_element(foot, foot + std::ptrdiff_t(std::min(ahead, left)), nearer);
        feet[n] = std::size_t(foot - path.begin());
    }
    return feet;
}

double lengthOf(const Polyline& line, std::size_t from, std::size_t to)
{
    double length_mm = 0;
    for (std::size_t n = from; n < to; ++n)
        length_mm += distance(line[n], line[n + 1]);
    return length_mm;
}

/// The point between two points of the path, by a number with a fraction.
Point3 pointOf(const Polyline& path, double at)
{
    const auto n = std::min(std::size_t(at), path.size() - 2);
    return interpolate(path[n], path[n + 1], at - double(n));
}

}  // namespace

Polyline unwound(const Polyline& line, Polyline moved, const Polyline& path, const DistanceProbe& wall, double step_mm)
{
    const std::vector<Crossing> stretches = crossings(line, moved, wall, step_mm);
    if (stretches.empty() || path.size() < 2)
        return moved;
    const std::vector<std::size_t> feet = feetOn(path, line, step_mm);
    for (const auto& [from, to] : stretches) {
        const double path_mm = step_mm * double(feet[to] - feet[from]);
        if (lengthOf(moved, from, to) < kWound * path_mm)
            continue;
        const Vector3 at_start = moved[from] - path[feet[from]], at_end = moved[to] - path[feet[to]];
        for (std::size_t n = from; n <= to; ++n) {
            const double t = double(n - from) / double(to - from);
            const Point3 on_path = pointOf(path, std::lerp(double(feet[from]), double(feet[to]), t));
            moved[n] = keptInside(on_path + at_start * (1 - t) + at_end * t, on_path, wall);
        }
    }
    return moved;
}

}  // namespace vicon::steps
