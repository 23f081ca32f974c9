#include "skeleton/ends.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "skeleton/section.h"

namespace vicon::steps {
namespace {

// Chosen on phantoms 1, 3 and 301 to 305, full size.
constexpr double kTipWindow_mm = 20;   // how far ahead the lumen is looked at to tell a tip from the lumen
constexpr double kTipStretch_mm = 4;   // of the curve, two of them for the radius at its end
constexpr double kMostWidening = 0.3;  // mm of radius per mm: more is not the tip
constexpr int kTipRounds = 4;
constexpr double kSettled_mm = 0.1;
constexpr double kMostMoved_mm = 10;  // of an end of the curve, when the lumen's tip is measured from it
constexpr double kHookReach = 4;      // radii along the curve within which it may come back to its beginning
constexpr double kHook = 0.45;        // of the way gone, what is left of it as the crow flies

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
    const auto radiusOver = [&](double from_mm, double to_mm) {
        std::vector<double> radii;
        for (auto m = std::size_t(from_mm / step_mm); m < line.size() && m <= std::size_t(to_mm / step_mm); ++m)
            for (int n = 0; n < 16; ++n)
                radii.push_back(reach(wall, line[m], across(n), kTipWindow_mm * 2));
        return radii.empty() ? 0 : medianOf(radii);
    };
    // The lumen mostly widens away from its tip: from two stretches to the first point.
    const double near_mm = radiusOver(0, kTipStretch_mm), next_mm = radiusOver(kTipStretch_mm, 2 * kTipStretch_mm);
    const double widens = std::clamp((next_mm - near_mm) / kTipStretch_mm, -kMostWidening, kMostWidening);
    const double radius_mm = near_mm - widens * kTipStretch_mm / 2;
    std::vector<double> ahead;
    for (const double slope : {0.3, 0.6, 0.9})
        for (int n = 0; n < 16; ++n) {
            const double far = reach(wall, line.front(), normalized(along + across(n) * slope), 3 * radius_mm);
            const double height = far / std::sqrt(1 + slope * slope), off = height * slope;
            ahead.push_back(height - std::sqrt(std::max(0.0, radius_mm * radius_mm - off * off)));
        }
    return medianOf(ahead);
}

/// At the end of a wide pouch sections turn with the few points that there are, and the line may begin by going there
/// and back, 24 mm each way in the rectum of the prone reference scan. A line that comes back nearly to its beginning
/// begins there instead. No lumen does so within its own width: a hairpin of a tube comes back to two radii after pi.
void dropHook(Polyline& line, const DistanceProbe& wall, double step_mm)
{
    const auto reach = std::min(line.size() / 2, std::size_t(kHookReach * wall.at(line.front()) / step_mm));
    std::size_t back = 0;
    double least = kHook;
    for (std::size_t n = 1; n < reach; ++n)
        if (const double share = distance(line[n], line.front()) / (double(n) * step_mm); share < least) {
            least = share;
            back = n;
        }
    line.erase(line.begin(), line.begin() + std::ptrdiff_t(back));
}

/// The line, longer by so much in its first direction, or shorter where that is below 0.
void moveStart(Polyline& line, double by_mm, Vector3 along, const DistanceProbe& wall, double step_mm)
{
    const Point3 first = line.front();
    for (double s = std::min(step_mm, by_mm); s > 0; s = s < by_mm ? std::min(s + step_mm, by_mm) : 0) {
        if (!wall.inside(first + along * s))
            return;
        line.insert(line.begin(), first + along * s);
    }
    double left_mm = std::max(0.0, -by_mm);
    std::size_t whole = 0;
    while (whole + 2 < line.size() && whole < line.size() / 4 && distance(line[whole], line[whole + 1]) <= left_mm) {
        left_mm -= distance(line[whole], line[whole + 1]);
        ++whole;
    }
    line.erase(line.begin(), line.begin() + std::ptrdiff_t(whole));
    if (left_mm > 0)
        line.front() = interpolate(line[0], line[1], std::min(1.0, left_mm / distance(line[0], line[1])) * 0.999);
}

/// Lengthens or shortens the line so that it begins one local radius inside the lumen's tip: the path from which it was
/// made may run beside the middle there, and so take the local radius for smaller. The radius is that at the start,
/// so once moved it is looked at again.
void beginOneRadiusIn(Polyline& line, const DistanceProbe& wall, double step_mm)
{
    double moved_mm = 0;
    for (int round = 0; round < kTipRounds; ++round) {
        const std::size_t back = std::min(line.size() - 1, std::size_t(8 / step_mm));
        const Vector3 along = normalized(line.front() - line[back]);
        const double to_mm = std::clamp(moved_mm + ballAhead(line, wall, step_mm), -kMostMoved_mm, kMostMoved_mm);
        moveStart(line, to_mm - moved_mm, along, wall, step_mm);
        if (std::abs(to_mm - moved_mm) < kSettled_mm)
            return;
        moved_mm = to_mm;
    }
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
        dropHook(line, wall, step_mm);
        beginOneRadiusIn(line, wall, step_mm);
    }
    return line;
}

}  // namespace vicon::steps
