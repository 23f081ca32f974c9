// The wall about a centreline, against closed forms.
#include "vicon/cases/wall_relief.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vicon {
namespace {

/// Along the body's axis, from the foot to the head, with a bridge in its middle.
Skeleton straight()
{
    const auto at = [](double z) { return SkeletonPoint{{0, 0, z}, z, 10}; };
    return {{SkeletonPiece{.points = {at(0), at(18)}}, SkeletonPiece{.bridge = true, .points = {at(18), at(22)}},
             SkeletonPiece{.points = {at(22), at(40)}}}};
}

/// Lumen where `holds` says so, half a millimetre a voxel.
template <class Holds>
InsideVolume lumenOf(Holds holds)
{
    InsideVolume inside;
    inside.grid.size = {121, 121, 81};
    inside.grid.spacing_mm = {0.5, 0.5, 0.5};
    inside.grid.origin_mm = {-30, -30, 0};
    for (int k = 0; k < 81; ++k)
        for (int j = 0; j < 121; ++j)
            for (int i = 0; i < 121; ++i)
                inside.voxels.push_back(holds(-30 + 0.5 * i, -30 + 0.5 * j, 0.5 * k) ? kGas : kOutside);
    return inside;
}

double angleOf(std::size_t direction)
{
    return 2 * M_PI * double(direction) / WallRelief::kDirections;
}

TEST(WallRelief, OfATubeBesideTheCentrelineIsItsCircle)
{
    constexpr double kRadius_mm = 15, kAside_mm = 5;  // towards the front: the first direction
    const auto relief = reliefOf(
        lumenOf([](double x, double y, double) { return std::hypot(x, y + kAside_mm) < kRadius_mm; }), straight());
    ASSERT_EQ(relief.radius_mm.size(), 41U);
    for (const std::size_t station : {5U, 20U, 35U})
        for (std::size_t d = 0; d < WallRelief::kDirections; ++d) {
            const double across = kAside_mm * std::sin(angleOf(d));
            const double expected =
                kAside_mm * std::cos(angleOf(d)) + std::sqrt(kRadius_mm * kRadius_mm - across * across);
            EXPECT_NEAR(relief.radius_mm[station][d], expected, 0.6) << station << " " << d;
        }
}

TEST(WallRelief, AFoldStandsAtItsStationAndOnItsSide)
{
    // On the patient's left, which is to the right of one who looks towards the head with the front above.
    const auto relief = reliefOf(lumenOf([](double x, double y, double z) {
                                     const bool fold = std::abs(z - 30) < 2 && x > 8;
                                     return std::hypot(x, y) < 15 && !fold;
                                 }),
                                 straight());
    const std::size_t left = WallRelief::kDirections / 4;
    EXPECT_NEAR(relief.radius_mm[30][left], 8, 0.6);
    EXPECT_NEAR(relief.radius_mm[30][3 * left], 15, 0.6);
    EXPECT_NEAR(relief.radius_mm[25][left], 15, 0.6);
}

TEST(WallRelief, IsNothingWhereTheCentrelineIsNoLumenAndEndsSomewhere)
{
    const auto closed =
        reliefOf(lumenOf([](double x, double y, double z) { return std::hypot(x, y) < 15 && std::abs(z - 20) > 1; }),
                 straight());
    EXPECT_EQ(closed.radius_mm[20][0], 0);
    const auto open = reliefOf(lumenOf([](double, double, double) { return true; }), straight());
    EXPECT_NEAR(open.radius_mm[10][0], 30, 1) << "the scan's end is a wall";
    EXPECT_TRUE(reliefOf({}, {}).radius_mm.empty());
}

}  // namespace
}  // namespace vicon
