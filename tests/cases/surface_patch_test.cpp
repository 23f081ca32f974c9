#include "surface_patch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "polyp_profile.h"

namespace vicon {
namespace {

constexpr int kAcross = 13;
constexpr double kEdge_mm = 2, kHalf_mm = kEdge_mm * (kAcross / 2);

double heightAt(double x, double y)
{
    return x * x / 40 + y * y / 80;
}

/// A bowl above the plane of x and y: squares of two triangles each.
CellSurface bowl()
{
    CellSurface surface;
    for (int j = 0; j < kAcross; ++j)
        for (int i = 0; i < kAcross; ++i) {
            const double x = i * kEdge_mm - kHalf_mm, y = j * kEdge_mm - kHalf_mm;
            surface.points_mm.insert(surface.points_mm.end(), {float(x), float(y), float(heightAt(x, y))});
            surface.normals.insert(surface.normals.end(), {0, 0, 1});
        }
    for (std::uint32_t j = 0; j + 1 < kAcross; ++j)
        for (std::uint32_t i = 0; i + 1 < kAcross; ++i) {
            const std::uint32_t n = j * kAcross + i;
            surface.triangles.insert(surface.triangles.end(),
                                     {n, n + 1, n + kAcross, n + 1, n + kAcross + 1, n + kAcross});
        }
    surface.segment.assign(surface.triangles.size() / 3, 1);
    return surface;
}

/// The middle of the triangle over or under a place.
Point3 middleOfTriangle(Point3 p)
{
    const double u = (p.x + kHalf_mm) / kEdge_mm, v = (p.y + kHalf_mm) / kEdge_mm;
    const double i = std::floor(u), j = std::floor(v), third = u - i + v - j < 1 ? 1.0 / 3 : 2.0 / 3;
    return {(i + third) * kEdge_mm - kHalf_mm, (j + third) * kEdge_mm - kHalf_mm, 0};
}

TEST(SurfacePatch, ASectionLeavesTheTriangleThatTheAxisMeets)
{
    const SurfacePatch patch(bowl(), {0, 0, 0}, 20, 3);
    for (const Point3 near : {Point3{0.3, 0.4, 1}, {-3.7, 2.2, -1}, {5.1, -4.3, 5}, {-6.3, -6.6, 0}, {3.9, 3.9, -2}})
        for (int n = 0; n < 8; ++n) {
            const double angle = 0.1 + n * std::numbers::pi / 4;
            const Vector3 out{std::cos(angle), std::sin(angle), 0};
            const std::vector<Point3> section = patch.section(patch.onAxis(near, {0, 0, 1}).value(), {0, 0, 1}, out, 4);
            const Point3 middle = middleOfTriangle(near);
            ASSERT_GE(section.size(), 2U);
            EXPECT_LT(std::hypot(section.front().x - middle.x, section.front().y - middle.y), kEdge_mm);
            double length_mm = 0;
            for (std::size_t m = 0; m < section.size(); ++m) {
                length_mm += m > 0 ? distance(section[m - 1], section[m]) : 0;
                const Vector3 from = section[m] - middle;
                EXPECT_NEAR(from.x * out.y - from.y * out.x, 0, 1e-5) << "in the half plane";
                EXPECT_GT(from.x * out.x + from.y * out.y, 0);
                EXPECT_NEAR(section[m].z, heightAt(section[m].x, section[m].y), 0.05);
            }
            EXPECT_GE(length_mm, 4);
        }
}

TEST(SurfacePatch, HoldsThePointsOfItsPartOfTheSurfaceAlone)
{
    CellSurface two = bowl();
    const auto count = std::uint32_t(two.pointCount());
    const CellSurface above = bowl();
    for (std::size_t n = 0; n < above.points_mm.size(); ++n)
        two.points_mm.push_back(above.points_mm[n] + (n % 3 == 2 ? 5.F : 0.F));
    two.normals.insert(two.normals.end(), above.normals.begin(), above.normals.end());
    for (const std::uint32_t corner : above.triangles)
        two.triangles.push_back(corner + count);
    two.segment.assign(two.triangles.size() / 3, 1);
    const SurfacePatch patch(two, {0, 0, 0}, 20, 3);
    EXPECT_TRUE(patch.holds(two.point(kAcross + 1)));
    EXPECT_FALSE(patch.holds(two.point(count + kAcross + 1)));
}

TEST(PolypProfile, AHeadHoldsWhatLiesBelowItAndALittleBesideIt)
{
    PolypProfile half_ball;
    constexpr int kPoints = 30;
    for (int n = 0; n <= kPoints; ++n) {
        const double angle = n * std::numbers::pi / 2 / kPoints;
        half_ball.out_mm.push_back(5 * std::sin(angle));
        half_ball.up_mm.push_back(5 * std::cos(angle) - 5);
    }
    const auto holds = [&](double out_mm, double up_mm) { return headHolds(half_ball, kPoints, -5, out_mm, up_mm, 1); };
    EXPECT_TRUE(holds(0, -3) && holds(3, -3) && holds(4.5, -4.9));
    EXPECT_TRUE(holds(0, 0.8) && holds(5.9, -5) && holds(2, -5.9)) << "within a millimetre of it";
    EXPECT_FALSE(holds(0, 1.2) || holds(6.2, -5) || holds(2, -6.1) || holds(5, -1));
}

}  // namespace
}  // namespace vicon
