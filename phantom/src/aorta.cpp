#include <cmath>
#include <numbers>

#include "tubes.h"

namespace vicon::phantom {
namespace {

/// Points on a smooth line through stops (Catmull and Rom), with radii in between.
struct Line {
    std::vector<Point3> points;
    std::vector<double> radii_mm;
};

Line through(const std::vector<Point3>& stops, const std::vector<double>& radii_mm)
{
    constexpr int kParts = 8;
    Line line;
    const auto at = [&](std::ptrdiff_t n) {
        const auto last = std::ptrdiff_t(stops.size()) - 1;
        if (n < 0)
            return stops[0] + (stops[0] - stops[1]);
        if (n > last)
            return stops[std::size_t(last)] + (stops[std::size_t(last)] - stops[std::size_t(last) - 1]);
        return stops[std::size_t(n)];
    };
    for (std::size_t n = 0; n + 1 < stops.size(); ++n)
        for (int part = n == 0 ? 0 : 1; part <= kParts; ++part) {
            const double t = double(part) / kParts;
            const auto m = std::ptrdiff_t(n);
            const Vector3 a = at(m - 1) - Point3{}, b = at(m) - Point3{}, c = at(m + 1) - Point3{},
                          d = at(m + 2) - Point3{};
            line.points.push_back(Point3{} + (b * 2 + (c - a) * t + (a * 2 - b * 5 + c * 4 - d) * (t * t) +
                                              (b * 3 - a - c * 3 + d) * (t * t * t)) *
                                                 0.5);
            line.radii_mm.push_back(std::lerp(radii_mm[n], radii_mm[n + 1], t));
        }
    return line;
}

}  // namespace

SkeletonTree drawAorta(std::uint64_t seed)
{
    Random random(seed, "aorta");
    const auto shift = [&](double most) { return random.uniform(-most, most); };
    const double wide = random.uniform(0.92, 1.08), bow = random.uniform(0, 8);
    const Point3 first{-6, -16, 122 + shift(3)}, second{6, -6, 128 + shift(3)}, third{17, 6, 123 + shift(3)},
        fork{4 + shift(4), 28, -125 + shift(6)};
    SkeletonTree tree;
    // Ascending on the patient's right in front, over the arch to the left and behind, down beside the spine.
    const auto add = [&](int parent, const Line& line) { return addBranch(tree, parent, line.points, line.radii_mm); };
    const int ascending = add(-1, through({{-2, -22, 45}, {-16, -26, 70}, {-16, -24, 102}, first},
                                          {15 * wide, 15.5 * wide, 15 * wide, 14 * wide}));
    const auto artery = [&](int parent, Point3 from, Vector3 away, double radius) {
        add(parent, through({from, from + away * 25, from + away * 48 + Vector3{shift(4), shift(4), 0}},
                            {radius, radius, radius * 0.9}));
    };
    artery(ascending, first, normalized(Vector3{-0.45, -0.1, 1}), 6);
    const int arch = add(ascending, through({first, second}, {14 * wide, 13.5 * wide}));
    artery(arch, second, normalized(Vector3{-0.05, -0.1, 1}), 4.5);
    const int end = add(arch, through({second, third}, {13.5 * wide, 13 * wide}));
    artery(end, third, normalized(Vector3{0.5, 0.15, 1}), 5);
    const int descending =
        add(end, through({third, {25, 30, 96}, {24, 36, 50}, {18 + bow, 36, 0}, {8 + bow / 2, 31, -60}, fork},
                         {13 * wide, 12.5 * wide, 12 * wide, 11 * wide, 9.5 * wide, 9 * wide}));
    for (const double side : {-1.0, 1.0})
        add(descending,
            through({fork, fork + Vector3{side * 20, -2, -28}, fork + Vector3{side * 44, 4, -62}}, {6.2, 6, 5.4}));
    return inOrder(tree);
}

double trunkHu(Point3 p, double aorta_mm)
{
    if (std::hypot(p.x / 135, p.y / 100) > 1)
        return -1000;
    // Vertebrae of 26 mm with discs between them; their spongy bone is as dense as thin contrast.
    const double spine = std::hypot(p.x, p.y - 58), along = p.z - 30 * std::floor(p.z / 30);
    if (spine < 19 && aorta_mm > 1.2)
        return along > 26 ? 90 : spine > 17.3 ? 480 : 260;
    if (std::hypot(p.x / 12, (p.y - 92) / 7) < 1 && p.z > -180)
        return 500;
    const double ribs = (1 - std::hypot(p.x / 120, p.y / 88)) * 88;
    if (ribs > 0 && std::abs(p.x) > 42 && p.z > -10 && p.z < 130)
        return -860;
    if (std::hypot(p.x + 45, p.y + 20) < 32 && p.z < -20 && p.z > -90)
        return 110;  // a liver
    return 40;
}

}  // namespace vicon::phantom
