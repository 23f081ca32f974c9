#include "skeleton_ends.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "skeleton_section.h"

namespace vicon::steps {
namespace {

// Chosen on phantoms 1 (supine) and 3 (supine), full size.
constexpr double kTipWindow_mm = 20;      // how far ahead the lumen is looked at to tell a tip from the lumen
constexpr double kTipRadiusOver_mm = 12;  // of the curve, for the radius at its end
constexpr double kMostMoved_mm = 10;      // of an end of the curve, when the lumen's tip is measured from it

Polyline withoutFirstTip(const Polyline& path, const DistanceProbe& wall)
{
    const Point3 tip = path.front();
    const double tip_mm = wall.at(tip);
    for (std::size_t n = 0; n < path.size(); ++n) {
        double widest = 0;
        for (std::size_t m = n; m < path.size() && distance(path[m], path[n]) <= kTipWindow_mm; ++m)
            widest = std::max(widest, wall.at(path[m]));
        if (distance(path[n], tip) + tip_mm >= widest)
            return {path.begin() + std::ptrdiff_t(std::min(n, path.size() - 2)), path.end()};
    }
    return path;
}

double medianOf(std::vector<double> values)
{
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// How far beyond the first point, in the line's direction, lies the centre of a ball that fills the lumen's tip and is
/// as wide as the lumen after it. The medians are over rays, most of which meet neither a fold nor a rectal tube.
double ballAhead(const Polyline& line, const DistanceProbe& wall, double step_mm)
{
    const std::size_t back = std::min(line.size() - 1, std::size_t(8 / step_mm));
    const Vector3 along = normalized(line.front() - line[back]);
    const Vector3 u = normalized(cross(along, std::abs(along.x) < 0.9 ? Vector3{1, 0, 0} : Vector3{0, 1, 0}));
    const Vector3 v = cross(along, u);
    const auto across = [&](int n) {
        return u * std::cos(std::numbers::pi * n / 8) + v * std::sin(std::numbers::pi * n / 8);
    };
    std::vector<double> radii, ahead;
    for (std::size_t m = 0; m < line.size() && distance(line[m], line.front()) <= kTipRadiusOver_mm; ++m)
        for (int n = 0; n < 16; ++n)
            radii.push_back(reach(wall, line[m], across(n), kTipWindow_mm * 2));
    const double radius_mm = medianOf(radii);
    for (const double slope : {0.3, 0.6, 0.9})
        for (int n = 0; n < 16; ++n) {
            const double far = reach(wall, line.front(), normalized(along + across(n) * slope), 3 * radius_mm);
            const double height = far / std::sqrt(1 + slope * slope), off = height * slope;
            ahead.push_back(height - std::sqrt(std::max(0.0, radius_mm * radius_mm - off * off)));
        }
    return medianOf(ahead);
}

/// Lengthens or shortens the line so that it begins one local radius inside the lumen's tip: the path from which it was
/// made may run beside the middle there, and so take the local radius for smaller.
void beginOneRadiusIn(Polyline& line, const DistanceProbe& wall, double step_mm)
{
    const std::size_t back = std::min(line.size() - 1, std::size_t(8 / step_mm));
    const double move_mm = std::clamp(ballAhead(line, wall, step_mm), -kMostMoved_mm, kMostMoved_mm);
    const Vector3 along = normalized(line.front() - line[back]);
    const Point3 first = line.front();
    for (double s = step_mm; s <= move_mm && wall.inside(first + along * s); s += step_mm)
        line.insert(line.begin(), first + along * s);
    const auto cut = std::min(line.size() / 4, std::size_t(std::lround(std::max(0.0, -move_mm) / step_mm)));
    line.erase(line.begin(), line.begin() + std::ptrdiff_t(cut));
}

}  // namespace

Polyline withoutTips(const Polyline& path, const DistanceProbe& wall)
{
    Polyline line = withoutFirstTip(path, wall);
    std::reverse(line.begin(), line.end());
    line = withoutFirstTip(line, wall);
    std::reverse(line.begin(), line.end());
    return line;
}

Polyline endsOneRadiusIn(Polyline line, const DistanceProbe& wall, double step_mm)
{
    for (int end = 0; end < 2; ++end) {
        std::reverse(line.begin(), line.end());
        beginOneRadiusIn(line, wall, step_mm);
    }
    return line;
}

}  // namespace vicon::steps
