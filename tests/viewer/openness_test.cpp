#include "vicon/viewer/model/openness.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "test_surface.h"
#include "vicon/core/error.h"

namespace vicon::viewer {
namespace {

constexpr double kSpacing_mm = 0.8, kHalf_mm = 20;
using Field = std::function<double(Point3)>;  // distance to the wall, below 0 in the lumen

struct Wall {
    InsideVolume inside;
    FieldVolume distance;
    CellSurface surface;
    std::vector<float> openness;

    explicit Wall(const Field& field)
    {
        Grid grid;
        const int side = int(std::ceil(2 * kHalf_mm / kSpacing_mm)) + 1;
        grid.size = {side, side, side};
        grid.spacing_mm = {kSpacing_mm, kSpacing_mm, kSpacing_mm};
        grid.origin_mm = {-kHalf_mm, -kHalf_mm, -kHalf_mm};
        inside = InsideVolume(grid);
        distance = FieldVolume(grid);
        std::vector<float> values(grid.voxelCount());
        for (std::size_t n = 0; n < values.size(); ++n) {
            values[n] = float(field(grid.pointAt(grid.indexOf(n))));
            inside.voxels[n] = values[n] < 0 ? kGas : kOutside;
            distance.voxels[n] = std::max(0.0F, -values[n]);
        }
        surface = test::surfaceOf(grid, values, field, [](Point3) { return 0; });
        openness = opennessOf(surface.points_mm, surface.normals, Lumen(inside, distance));
    }

    /// The least and the most of the points for which `chosen` holds, away from the ends of the box.
    std::pair<double, double> rangeWhere(const std::function<bool(Point3)>& chosen) const
    {
        constexpr double kEnd_mm = 9;  // farther than what is looked at from a point
        std::pair<double, double> range{1e9, -1e9};
        for (std::size_t n = 0; n < openness.size(); ++n)
            if (const Point3 p = surface.point(n); std::abs(p.z) < kHalf_mm - kEnd_mm && chosen(p))
                range = {std::min(range.first, double(openness[n])), std::max(range.second, double(openness[n]))};
        return range;
    }
};

double tube(Point3 p, double radius_mm)
{
    return std::hypot(p.x, p.y) - radius_mm;
}

TEST(Openness, OfAPlainTubeIsFull)
{
    const Wall wall([](Point3 p) { return tube(p, 15); });
    ASSERT_EQ(wall.openness.size(), wall.surface.pointCount());
    const auto [least, most] = wall.rangeWhere([](Point3) { return true; });
    EXPECT_GT(least, 0.97);
    EXPECT_LE(most, 1);
}

TEST(Openness, IsLessAtTheFootOfAPolypAndFullOnTop)
{
    const Point3 polyp{14, 0, 0};  // its middle, on the wall
    constexpr double radius = 4;
    const Wall wall([&](Point3 p) { return std::max(tube(p, 15), radius - distance(p, polyp)); });
    const auto beside = [&](double from_mm, double to_mm) {
        return wall.rangeWhere([=](Point3 p) {
            const double away = distance(p, polyp) - radius;
            return away >= from_mm && away < to_mm;
        });
    };
    EXPECT_LT(beside(0.2, 1.2).first, 0.75);
    EXPECT_GT(beside(8, 9).first, 0.93);  // nothing is known of it there
    const auto top = wall.rangeWhere([&](Point3 p) { return distance(p, polyp) < radius + 0.2 && p.x < 11; });
    EXPECT_GT(top.first, 0.9);
    const auto side = wall.rangeWhere(
        [&](Point3 p) { return distance(p, polyp) < radius + 0.2 && p.x > 0 && std::hypot(p.x, p.y) < 12.5; });
    EXPECT_GT(side.first, 0.5);  // which leaves half of the light: only its foot is darker
}

TEST(Openness, IsSmallInACleft)
{
    const Wall wall([](Point3 p) { return std::max(tube(p, 15), std::abs(p.x) - 2); });
    const auto [least, most] = wall.rangeWhere([](Point3 p) { return std::abs(p.y) < 8; });
    EXPECT_GE(least, 0);
    EXPECT_LT(most, 0.5);
}

TEST(Openness, WhatIsNoLongerWantedStops)
{
    struct Stopped : NoProgress {
        bool cancelled() const override { return true; }
    } stopped;
    const Wall wall([](Point3 p) { return tube(p, 15); });
    EXPECT_THROW(opennessOf(wall.surface.points_mm, wall.surface.normals, Lumen(wall.inside, wall.distance), &stopped),
                 Error);
}

}  // namespace
}  // namespace vicon::viewer
