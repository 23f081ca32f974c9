#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tissue_scene.h"
#include "vicon/support/support.h"

namespace vicon::steps {
namespace {

/// Half a ball on a flat wall, with a level beside, above or across it.
struct PolypAtLevel {
    double wall_degrees;  ///< 0: it stands on the floor, 90: on an upright wall, 135: it hangs over the fluid
    double diameter_mm;
    double sunk;     ///< how far its middle lies under the level, as a part of its radius
    double rise_mm;  ///< of the fluid beside the wall

    double radius_mm() const { return diameter_mm / 2; }
    Vector3 out() const
    {
        const double angle = wall_degrees * std::numbers::pi / 180;
        return {std::sin(angle), std::cos(angle), 0};
    }
    Point3 middle() const { return Point3{} - out() * (radius_mm() / 2); }
    /// Positive in tissue, mm.
    double depth_mm(Point3 p) const
    {
        const Vector3 from_centre = p - Point3{};
        return std::max(dot(from_centre, out()), radius_mm() - length(from_centre));
    }
    double level_mm(Point3 p) const
    {
        constexpr double kWidth_mm = 1.5;
        return middle().y - sunk * radius_mm() - rise_mm * std::exp(std::min(0.0, depth_mm(p)) / kWidth_mm);
    }
};

/// Across the polyp at half its height.
double diameterIn(const TissueVolume& tissue, const PolypAtLevel& polyp)
{
    constexpr int kDirections = 24;
    const Vector3 out = polyp.out(), aside{out.y, -out.x, 0}, along{0, 0, 1};
    double sum = 0;
    for (int n = 0; n < kDirections; ++n) {
        const double turn = 2 * std::numbers::pi * n / kDirections;
        sum += toWall_mm(tissue, polyp.middle(), aside * std::cos(turn) + along * std::sin(turn));
    }
    return 2 * sum / kDirections;
}

double errorOfDiameter_mm(const PolypAtLevel& polyp)
{
    const Scene scene([&](Point3 p) { return polyp.depth_mm(p) > 0; },
                      std::function([&](Point3 p) { return polyp.level_mm(p); }), 20);
    return diameterIn(scene.find().tissue, polyp) - diameterIn(scene.blurredTruth(), polyp);
}

/// On floors, where over millimetres fluid is thinner than the blur, a polyp of 6 mm loses 0.9 mm at worst.
TEST(PolypsAtLevels, KeepTheirDiameter)
{
    std::vector<double> errors_mm;
    for (const double rise_mm : {0.0, 1.0})
        for (const double wall_degrees : {0.0, 45.0, 90.0, 135.0})
            for (const double diameter_mm : {6.0, 8.0, 10.0})
                for (const double sunk : {-0.45, -0.15, 0.15, 0.45, 0.75}) {
                    const bool sampled = rise_mm == 0 && diameter_mm == 6 && std::abs(sunk) < 0.2;
                    if (!sampled && !support::inFull())
                        continue;
                    const double error_mm = errorOfDiameter_mm({wall_degrees, diameter_mm, sunk, rise_mm});
                    EXPECT_LT(std::abs(error_mm), wall_degrees == 0 ? 0.9 : 0.7)
                        << diameter_mm << " mm on a wall of " << wall_degrees << " degrees, sunk by " << sunk
                        << ", fluid risen by " << rise_mm << " mm";
                    errors_mm.push_back(std::abs(error_mm));
                }
    const auto middle = errors_mm.begin() + std::ptrdiff_t(errors_mm.size() / 2);
    std::nth_element(errors_mm.begin(), middle, errors_mm.end());
    EXPECT_LT(*middle, 0.4);
}

}  // namespace
}  // namespace vicon::steps
