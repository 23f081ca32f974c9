#include "vicon/core/skeleton.h"

#include <gtest/gtest.h>

namespace vicon {
namespace {

/// 10 mm along x, a bridge of 10 mm along y, 10 mm back along x.
Skeleton uTurn()
{
    Skeleton s;
    s.pieces.push_back({false, {{{0, 0, 0}, 0, 5}, {{10, 0, 0}, 10, 3}}});
    s.pieces.push_back({true, {{{10, 0, 0}, 10, 3}, {{10, 10, 0}, 20, 3}}});
    s.pieces.push_back({false, {{{10, 10, 0}, 20, 3}, {{0, 10, 0}, 30, 5}}});
    return s;
}

TEST(Skeleton, InterpolatesPositionStationAndRadius)
{
    const SkeletonPoint p = uTurn().at(5);
    EXPECT_NEAR(distance(p.position_mm, {5, 0, 0}), 0, 1e-12);
    EXPECT_DOUBLE_EQ(p.radius_mm, 4);
    EXPECT_DOUBLE_EQ(uTurn().at(-7).station_mm, 0);
    EXPECT_DOUBLE_EQ(uTurn().at(99).station_mm, 30);
}

TEST(Skeleton, KnowsItsBridges)
{
    EXPECT_FALSE(uTurn().onBridge(5));
    EXPECT_TRUE(uTurn().onBridge(15));
    EXPECT_FALSE(uTurn().onBridge(25));
}

TEST(Skeleton, FindsTheNearestPointWithinTheStationsAskedFor)
{
    const Point3 p{3, 4, 0};
    EXPECT_DOUBLE_EQ(uTurn().nearest(p).station_mm, 3);
    EXPECT_DOUBLE_EQ(uTurn().nearest(p, 20, 30).station_mm, 27);
    EXPECT_DOUBLE_EQ(uTurn().nearest(p, 20, 30).distance_mm, 6);
}

TEST(Skeleton, PointsItsTangentTowardsTheCaecum)
{
    EXPECT_NEAR(uTurn().tangentAt(5).x, 1, 1e-12);
    EXPECT_NEAR(uTurn().tangentAt(25).x, -1, 1e-12);
}

}  // namespace
}  // namespace vicon
