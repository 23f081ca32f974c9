#include "skeleton/swings.h"

#include <algorithm>
#include <cmath>

namespace vicon::steps {
namespace {

// Chosen on the second phantom's seed 714, whose line swung by 6 mm in the ascending colon, which moved stations by
// 8 mm, on tubes with folds by turns (skeleton_test) and on ctc-prone. With hairpins counted as swings, or from 0.8 on,
// the line of HuBMAP (reference shapes) falls to an OV of 0.970 and 0.960.
constexpr double kBent = 0.7, kSwings = 1;        // of radius x curvature
constexpr double kNarrow_mm = 10, kWide_mm = 15;  // of the wall's distance: in a narrow lumen no line swings
constexpr double kHairpin = 0.85, kStraight = 0.95;
constexpr double kOnBothSides_radii = 2;  // so far is seen whether the line goes on

/// Of a value between two limits, from 0 to 1.
double between(double value, double from, double to)
{
    return std::clamp((value - from) / (to - from), 0.0, 1.0);
}

/// The distance along the line about a point as a part of its way: a hairpin, which bends as tight, leads elsewhere.
double straightnessAt(const Polyline& line, std::size_t n, double half_mm, double step_mm)
{
    const auto half = std::max<std::size_t>(1, std::size_t(half_mm / step_mm));
    const std::size_t first = n > half ? n - half : 0, last = std::min(line.size() - 1, n + half);
    return distance(line[first], line[last]) / (double(last - first) * step_mm);
}

double swingAt(const Polyline& line, std::size_t n, const DistanceProbe& wall, double step_mm)
{
    const double radius_mm = wall.at(line[n]);
    const double tight = length(bendAt(line, n, step_mm)) * radius_mm;
    if (tight < kBent || radius_mm < kNarrow_mm)
        return 0;
    return between(tight, kBent, kSwings) * between(radius_mm, kNarrow_mm, kWide_mm) *
           between(straightnessAt(line, n, kOnBothSides_radii * radius_mm, step_mm), kHairpin, kStraight);
}

}  // namespace

std::vector<double> swingsOf(const Polyline& line, const DistanceProbe& wall, double step_mm)
{
    std::vector<double> swings(line.size()), spread(line.size(), 0);
    for (std::size_t n = 0; n < line.size(); ++n)
        swings[n] = swingAt(line, n, wall, step_mm);
    // Between two turns a swing is straight: what lies within a radius of one swings with it.
    for (std::size_t n = 0; n < line.size(); ++n) {
        const auto reach = std::size_t(wall.at(line[n]) / step_mm);
        for (std::size_t m = n > reach ? n - reach : 0; m < std::min(line.size(), n + reach + 1); ++m) {
            const double away = (double(m) - double(n)) / double(reach + 1);
            spread[n] = std::max(spread[n], swings[m] * (1 - away * away));
        }
    }
    return spread;
}

}  // namespace vicon::steps
