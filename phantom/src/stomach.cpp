#include "stomach.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tubes.h"

namespace vicon::phantom {
namespace {

constexpr double kFold_mm = 6, kFoldsApart_mm = 20, kWaver_mm = 5;
constexpr double kMouth_mm = 3;  // radius of gullet and pylorus
constexpr double kReach_mm = 8;  // of the fields around the gas
constexpr Point3 kTop{28, 12, 96}, kPylorus{-32, -15, -24};

FieldVolume tube(const Grid& grid, const std::vector<Point3>& points, const std::vector<double>& radii_mm)
{
    SkeletonTree tree;
    addBranch(tree, -1, points, radii_mm);
    return tubesField(grid, tree, kReach_mm);
}

void join(FieldVolume& to, const FieldVolume& other)
{
    std::transform(to.voxels.begin(), to.voxels.end(), other.voxels.begin(), to.voxels.begin(),
                   [](float a, float b) { return std::min(a, b); });
}

/// How high a fold stands at a place of the wall: sheets across the organ's width that waver along the body.
double fold_mm(Point3 p, double turn_rad, double phase_rad)
{
    const double across_mm = p.x * std::cos(turn_rad) + p.y * std::sin(turn_rad) + kWaver_mm * std::sin(p.z / 18);
    const double wave = std::cos(2 * std::numbers::pi * across_mm / kFoldsApart_mm + phase_rad);
    return kFold_mm * std::pow(std::max(0.0, wave), 6);
}

}  // namespace

StomachGas drawStomach(const Grid& grid, std::uint64_t seed)
{
    Random random(seed, "stomach");
    const double wide = random.uniform(0.94, 1.06), turn_rad = random.uniform(0.2, 1.2),
                 phase_rad = random.uniform(0, 2 * std::numbers::pi);
    const Vector3 lean{random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-4, 2)};
    const std::vector<Point3> stops{{48, 10, 68}, {45, -5, 35}, {38, -15, 0}, {18, -22, -26}, {-8, -22, -32}};
    std::vector<Point3> line;
    for (const Point3 stop : stops)
        line.push_back(stop + lean);
    StomachGas gas{tube(grid, line, {34 * wide, 32 * wide, 28 * wide, 22 * wide, 16}), {}};
    for (std::size_t n = 0; n < gas.stomach_mm.voxels.size(); ++n)
        gas.stomach_mm.voxels[n] += float(fold_mm(grid.pointAt(grid.indexOf(n)), turn_rad, phase_rad));
    gas.other_mm = tube(grid, {line.front(), kTop, {14, 22, 138}}, {kMouth_mm, kMouth_mm, kMouth_mm});
    join(gas.other_mm, tube(grid, {line.back(), kPylorus}, {kMouth_mm, kMouth_mm}));
    join(gas.other_mm, tube(grid, {{-38, -10, -22}, {-48, 4, -26}, {-50, 14, -60}}, {8, 10, 9}));
    join(gas.other_mm, tube(grid, {kPylorus, {-38, -10, -22}}, {kMouth_mm, kMouth_mm}));
    join(gas.other_mm, tube(grid, {{-85, -40, -95}, {0, -52, -90}, {92, -25, -95}}, {18, 19, 18}));
    return gas;
}

double abdomenHu(Point3 p)
{
    const double skin = std::hypot(p.x / 135, p.y / 100);
    if (skin > 1)
        return -1000;
    const double spine = std::hypot(p.x, p.y - 62);
    if (spine < 17)
        return spine < 15 ? 220 : 600;
    if (p.z > 114 && skin < 0.88 && std::abs(p.x) > 24)
        return -860;  // the lungs' lower ends
    if (skin > 0.9 || std::hypot(p.x + 70, p.y + 5, p.z - 50) < 48)
        return 55;  // muscle; the liver
    return -95;     // fat
}

}  // namespace vicon::phantom
