// Parts of the centreline's step, from their own headers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "skeleton/detour.h"
#include "skeleton/mean_line.h"
#include "skeleton/path_balls.h"

namespace vicon::steps {
namespace {

FieldVolume fieldOf(const std::function<double(Point3)>& wall_mm)
{
    FieldVolume field(Grid{.size = {61, 61, 61}, .origin_mm = {-30, -30, -30}});
    for (std::size_t n = 0; n < field.voxels.size(); ++n)
        field.voxels[n] = float(std::max(0.0, wall_mm(field.grid.pointAt(field.grid.indexOf(n)))));
    return field;
}

Polyline alongZ(double x_mm, double y_mm, double step_mm)
{
    Polyline line;
    for (double z = -25; z <= 25; z += step_mm)
        line.push_back({x_mm, y_mm, z});
    return line;
}

/// A slot 12 mm wide, turned about z, with a tube of 10 mm across in its middle in the middle of its length.
double inSlot(Point3 p, double angle)
{
    const double across = p.x * std::cos(angle) + p.y * std::sin(angle);
    const double tube_mm = std::hypot(p.x, p.y, std::max(0.0, std::abs(p.z) - 6)) - 5;
    return std::min({6 - std::abs(across), 24 - std::hypot(p.x, p.y), tube_mm});
}

TEST(BesideTube, ALineGoesRoundItWhereverThereIsRoom)
{
    constexpr double kStep_mm = 0.5;
    for (int n = 0; n < 12; ++n) {
        const double angle = n * std::numbers::pi / 12;
        const FieldVolume field = fieldOf([&](Point3 p) { return inSlot(p, angle); });
        const DistanceProbe wall(field);
        const Polyline line = besideTube(alongZ(0, 0, kStep_mm), wall, kStep_mm);
        ASSERT_EQ(line.size(), alongZ(0, 0, kStep_mm).size());
        for (std::size_t m = 0; m < line.size(); ++m) {
            const double off_mm = std::hypot(line[m].x, line[m].y);
            EXPECT_TRUE(wall.inside(line[m])) << n << " at " << line[m].z;
            EXPECT_LE(off_mm, 8) << "no farther than needed: " << n << " at " << line[m].z;
            if (std::abs(line[m].z) < 4) {
                EXPECT_GE(off_mm, 5.5) << n << " at " << line[m].z;
            }
            if (m > 0) {
                EXPECT_LT(distance(line[m - 1], line[m]), 2 * kStep_mm) << "evenly: " << n << " at " << line[m].z;
            }
        }
        EXPECT_LT(std::hypot(line.front().x, line.front().y), 0.5) << "away from the tube it stays";
        EXPECT_LT(std::hypot(line.back().x, line.back().y), 0.5);
    }
}

TEST(MeanLine, LiesBetweenLinesHoweverManyPointsTheyHave)
{
    const FieldVolume field = fieldOf([](Point3 p) { return 15 - std::hypot(p.x, p.y); });
    const DistanceProbe wall(field);
    const Polyline mean = meanLine({alongZ(-4, 2, 0.8), alongZ(1, 5, 1.1), alongZ(0, -1, 1)}, wall);
    ASSERT_EQ(mean.size(), alongZ(0, -1, 1).size()) << "of the last one";
    for (std::size_t n = 2; n + 2 < mean.size(); ++n)
        EXPECT_LT(distance(mean[n], {-1, 2, -25.0 + double(n)}), 1e-9);
    // Where the mean would lie in the wall, it goes as far as the lumen lets it.
    const FieldVolume two =
        fieldOf([](Point3 p) { return std::max(5 - std::hypot(p.x - 10, p.y), 5 - std::hypot(p.x + 10, p.y)); });
    const DistanceProbe parted(two);
    for (const Point3 p : meanLine({alongZ(-10, 0, 1), alongZ(10, 0, 1)}, parted))
        EXPECT_TRUE(parted.inside(p));
}

TEST(MeanLine, HalfwayIsHalfwayWhereThatIsInTheLumen)
{
    const FieldVolume field = fieldOf([](Point3 p) { return 15 - std::hypot(p.x, p.y); });
    const Polyline half = halfwayTo(alongZ(4, 0, 1), alongZ(-2, 6, 1), DistanceProbe(field));
    EXPECT_LT(distance(half[20], {1, 3, -5}), 1e-9);
    EXPECT_LT(distance(halfwayTo(alongZ(28, 0, 1), alongZ(14, 0, 1), DistanceProbe(field))[20], {14, 0, -5}), 1e-9);
}

TEST(PathBalls, OverATubeAreTheLargestThatTheLumenHas)
{
    const auto lumen_mm = [](Point3 p) { return 15 - std::hypot(p.x, p.y); };
    const auto beside_tube_mm = [&](Point3 p) { return std::min(lumen_mm(p), std::hypot(p.x, p.y) - 4); };
    const FieldVolume with_tube = fieldOf(beside_tube_mm), without = fieldOf(lumen_mm);
    const DistanceProbe wall(with_tube, without);
    const Polyline path = alongZ(9, 0, 1);
    ASSERT_TRUE(wall.overTube(path[10]));
    const PathBalls over(path, wall);
    const Point3 middle{-6, 0, 0};
    EXPECT_LT(distance(over.hold({middle}).front(), middle), 1e-9) << "within the ball about the lumen's middle";
    const DistanceProbe bare(with_tube);
    EXPECT_GT(PathBalls(path, bare).hold({middle}).front().x, 5) << "no tube: about the path itself";
}

}  // namespace
}  // namespace vicon::steps
