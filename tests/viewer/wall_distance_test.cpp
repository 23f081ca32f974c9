#include "vicon/viewer/model/wall_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "test_surface.h"

namespace vicon::viewer {
namespace {

constexpr double kSpacing_mm = 0.8;

/// The surface where a field is 0, contoured on voxels of 0.8 mm within a box of this half side.
CellSurface contoured(double half_mm, const std::function<double(Point3)>& field)
{
    Grid grid;
    const int side = int(std::ceil(2 * half_mm / kSpacing_mm)) + 1;
    grid.size = {side, side, side};
    grid.spacing_mm = {kSpacing_mm, kSpacing_mm, kSpacing_mm};
    grid.origin_mm = {-half_mm, -half_mm, -half_mm};
    std::vector<float> values(grid.voxelCount());
    for (std::size_t n = 0; n < values.size(); ++n)
        values[n] = float(field(grid.pointAt(grid.indexOf(n))));
    return test::surfaceOf(grid, values, field, [](Point3) { return 0; });
}

std::optional<WallDistance> measured(const CellSurface& surface, Point3 a, Point3 b)
{
    return distanceOverWall(surface.points_mm, surface.triangles, a, b);
}

TEST(WallDistance, OnASphereIsThatOfTheGreatCircle)
{
    constexpr double radius = 12;
    const auto ball = contoured(16, [](Point3 p) { return length(p - Point3{}) - radius; });
    for (const double degrees : {5.0, 40.0, 90.0, 170.0})
        for (const Vector3 axis : {Vector3{0, 0, 1}, normalized(Vector3{1, 2, -3}), normalized(Vector3{-2, 1, 0.3})}) {
            SCOPED_TRACE(degrees);
            const Vector3 u = normalized(cross(axis, Vector3{0.3, -0.2, 0.9})), v = cross(axis, u);
            const double angle = degrees * std::numbers::pi / 180;
            const Point3 a = Point3{} + u * radius;
            const Point3 b = Point3{} + (u * std::cos(angle) + v * std::sin(angle)) * radius;
            const auto found = measured(ball, a, b);
            ASSERT_TRUE(found);
            EXPECT_NEAR(found->straight_mm, distance(a, b), 0.05);
            EXPECT_NEAR(found->along_mm, radius * angle, 0.05 + 0.01 * radius * angle);
            double sum = 0;
            for (std::size_t n = 1; n < found->way_mm.size(); ++n)
                sum += distance(found->way_mm[n - 1], found->way_mm[n]);
            EXPECT_NEAR(sum, found->along_mm, 1e-6);
        }
}

TEST(WallDistance, OnATubeIsThatOfTheHelix)
{
    constexpr double radius = 10;
    const auto tube = contoured(30, [](Point3 p) { return std::hypot(p.x, p.y) - radius; });
    const auto at = [](double angle, double z) {
        return Point3{radius * std::cos(angle), radius * std::sin(angle), z};
    };
    const struct {
        double angle, rise;
    } cases[] = {{0.1, 1}, {1, 20}, {2.5, -15}, {3, 0}, {0, 30}};
    for (const auto& c : cases) {
        SCOPED_TRACE(c.angle);
        const Point3 a = at(0.4, -c.rise / 2), b = at(0.4 + c.angle, c.rise / 2);
        const double helix = std::hypot(radius * c.angle, c.rise);
        const auto found = measured(tube, a, b);
        ASSERT_TRUE(found);
        EXPECT_NEAR(found->along_mm, helix, 0.05 + 0.01 * helix);
        EXPECT_NEAR(found->straight_mm, distance(a, b), 0.05);
    }
}

TEST(WallDistance, GoesOverAPolypAndNotThroughIt)
{
    // A half ball of 5 mm on a plane; across it by its great circle, which beats the way around its foot.
    const auto wall = contoured(20, [](Point3 p) { return std::max(p.z, 5 - length(p - Point3{})); });
    const auto found = measured(wall, {-9, 0, 0}, {9, 0, 0});
    ASSERT_TRUE(found);
    const double tangent = std::sqrt(9.0 * 9 - 25), around = 2 * (tangent + 5 * std::asin(5.0 / 9));
    EXPECT_NEAR(found->straight_mm, 18, 0.05);
    EXPECT_NEAR(found->along_mm, around, 0.3) << "the way around its foot, on the plane";
}

TEST(WallDistance, IsNothingBetweenSurfacesThatNothingJoins)
{
    const auto two = contoured(20, [](Point3 p) {
        return std::min(length(p - Point3{-10, 0, 0}), length(p - Point3{10, 0, 0})) - 6;
    });
    EXPECT_FALSE(measured(two, {-4, 0, 0}, {4, 0, 0}));
    EXPECT_FALSE(distanceOverWall({}, {}, {0, 0, 0}, {1, 0, 0}));
    const auto nothing_between = measured(two, {-4, 0, 0}, {-4, 0, 0});
    ASSERT_TRUE(nothing_between);
    EXPECT_EQ(nothing_between->along_mm, 0);
}

}  // namespace
}  // namespace vicon::viewer
