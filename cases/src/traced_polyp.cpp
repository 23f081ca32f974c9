#include "traced_polyp.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace vicon {
namespace {

constexpr double kAtRim_mm = 1;

constexpr std::ptrdiff_t kWallFrom = 10, kWallTo = 18;  // points behind the rim: 2.5 to 4.5 mm, past the rounded corner
constexpr double kSteepestWall_rad = 0.8;               // steeper than where 30 mm stand in a narrow colon

void addCrossing(HeadCut& cut, Point3 a, Point3 b, double from, double to, bool rim)
{
    if ((from < 0) == (to < 0))
        return;
    cut.points.push_back(interpolate(a, b, from / (from - to)));
    cut.at_rim.push_back(rim);
}

}  // namespace

std::vector<Point3> TracedPolyp::rimPoints() const
{
    std::vector<Point3> rim;
    for (std::size_t n = 0; n < rims.size(); ++n)
        if (rims[n])
            rim.push_back(profiles[n].points[*rims[n]]);
    return rim;
}

HeadChord HeadCut::largest() const
{
    HeadChord chord;
    for (std::size_t a = 0; a < points.size(); ++a)
        for (std::size_t b = a + 1; b < points.size(); ++b)
            if (const double d = distance(points[a], points[b]); d > chord.length_mm)
                chord = {d, points[a], points[b], int(at_rim[a]) + int(at_rim[b])};
    return chord;
}

double HeadCut::area_mm2(Point3 middle, Vector3 along, Vector3 up) const
{
    std::vector<std::pair<double, double>> around;  // x, y
    for (const Point3& p : points)
        around.emplace_back(dot(p - middle, along), dot(p - middle, up));
    double x = 0, y = 0;
    for (const auto& p : around) {
        x += p.first / double(around.size());
        y += p.second / double(around.size());
    }
    std::sort(around.begin(), around.end(), [&](const auto& a, const auto& b) {
        return std::atan2(a.second - y, a.first - x) < std::atan2(b.second - y, b.first - x);
    });
    double twice = 0;
    for (std::size_t n = 0; n < around.size(); ++n) {
        const auto& [x0, y0] = around[n];
        const auto& [x1, y1] = around[(n + 1) % around.size()];
        twice += x0 * y1 - x1 * y0;
    }
    return std::abs(twice) / 2;
}

HeadChord largestChordOf(const TracedPolyp& polyp)
{
    HeadCut head;
    for (std::size_t n = 0; n < polyp.rims.size(); ++n) {
        if (!polyp.rims[n])
            continue;
        const std::size_t last = *polyp.rims[n];
        const auto add = [&](std::size_t p) {
            head.points.push_back(polyp.profiles[n].points[p]);
            head.at_rim.push_back(double(last - p) * PolypProfile::kStep_mm <= kAtRim_mm);
        };
        for (std::size_t p = 0; p < last; p += 2)
            add(p);
        add(last);
    }
    return head.largest();
}

HeadCut cutOf(const TracedPolyp& polyp, Vector3 normal, double at_mm)
{
    HeadCut cut;
    const auto off = [&](Point3 p) { return dot(p - polyp.top, normal) - at_mm; };
    const std::vector<Point3> rim = polyp.rimPoints();
    for (std::size_t n = 0; n < polyp.profiles.size(); ++n) {
        if (!polyp.rims[n])
            continue;
        const auto& points = polyp.profiles[n].points;
        for (std::size_t p = 0; p < *polyp.rims[n]; ++p)
            addCrossing(cut, points[p], points[p + 1], off(points[p]), off(points[p + 1]),
                        double(*polyp.rims[n] - p) * PolypProfile::kStep_mm <= kAtRim_mm);
    }
    for (std::size_t n = 0; n < rim.size(); ++n)
        addCrossing(cut, rim[n], rim[(n + 1) % rim.size()], off(rim[n]), off(rim[(n + 1) % rim.size()]), true);
    return cut;
}

double seenVolume_mm3(const TracedPolyp& polyp, Point3 middle)
{
    const double base = dot(middle - polyp.top, polyp.axis);
    double sum = 0;
    std::size_t wedges = 0;
    for (std::size_t n = 0; n < polyp.profiles.size(); ++n) {
        const PolypProfile& profile = polyp.profiles[n];
        if (!polyp.rims[n])
            continue;
        const auto under = [&](double r0, double h0, double r1, double h1) {
            return (r0 * r0 + r0 * r1 + r1 * r1) / 6 * (h0 - h1);
        };
        const std::size_t rim = *polyp.rims[n];
        for (std::size_t p = 0; p < rim; ++p)
            sum += under(profile.out_mm[p], profile.up_mm[p], profile.out_mm[p + 1], profile.up_mm[p + 1]);
        sum += under(profile.out_mm[rim], profile.up_mm[rim], 0, base);
        ++wedges;
    }
    return sum * 2 * std::numbers::pi / double(wedges);
}

double wallRise_rad(const TracedPolyp& polyp)
{
    std::vector<double> rises;
    for (std::size_t n = 0; n < polyp.rims.size(); ++n) {
        const std::vector<double>& turned = polyp.profiles[n].turned;
        if (!polyp.rims[n] || *polyp.rims[n] + std::size_t(kWallTo) >= turned.size())
            continue;
        const auto rim = turned.begin() + std::ptrdiff_t(*polyp.rims[n]);
        rises.push_back(std::accumulate(rim + kWallFrom, rim + kWallTo, 0.0) / double(kWallTo - kWallFrom));
    }
    std::sort(rises.begin(), rises.end());
    const auto quarter = std::ptrdiff_t(rises.size() / 4);
    const auto middle = std::ptrdiff_t(rises.size()) - 2 * quarter;
    if (middle == 0)
        return 0;
    const double mean = std::accumulate(rises.begin() + quarter, rises.end() - quarter, 0.0) / double(middle);
    return std::clamp(mean, -kSteepestWall_rad, kSteepestWall_rad);
}

double rimSlope2(const TracedPolyp& polyp, const HeadChord& chord)
{
    constexpr std::size_t kBeside = 2;  // points; one would be moved by noise more than by the wall
    const std::vector<Point3> rim = polyp.rimPoints();
    if (rim.size() <= 2 * kBeside)
        return 0;
    const auto slope2At = [&](Point3 end) {
        const auto nearest = std::min_element(rim.begin(), rim.end(), [&](const Point3& a, const Point3& b) {
            return distance(a, end) < distance(b, end);
        });
        const auto n = std::size_t(nearest - rim.begin());
        const Vector3 along = rim[(n + kBeside) % rim.size()] - rim[(n + rim.size() - kBeside) % rim.size()];
        const double rise_mm = dot(along, polyp.axis), way_mm = length(along - polyp.axis * rise_mm);
        return std::min(1.0, std::pow(rise_mm / std::max(way_mm, PolypProfile::kStep_mm), 2));
    };
    return (slope2At(chord.from) + slope2At(chord.to)) / 2;
}

double roughness_mm(const std::vector<Point3>& rim)
{
    const auto at = [&](std::size_t n) { return rim[n % rim.size()]; };
    double sum = 0;
    for (std::size_t n = 0; n < rim.size(); ++n) {
        const Point3 near = interpolate(at(n + 1), at(n + 3), 0.5), far = interpolate(at(n), at(n + 4), 0.5);
        sum += std::pow(distance(at(n + 2), interpolate(near, far, -1.0 / 3)), 2);
    }
    return std::sqrt(sum / double(rim.size()));
}

}  // namespace vicon
