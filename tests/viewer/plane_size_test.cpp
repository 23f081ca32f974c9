#include "vicon/viewer/model/plane_size.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace vicon::viewer {
namespace {

constexpr double kVoxel_mm = 0.7, kHalf_mm = 18;

/// A wall below z = 0 with gas above it, and what stands on it; voxels of 0.7 mm.
InsideVolume wallWith(const std::function<bool(Point3)>& tissue)
{
    Grid grid;
    const int n = 2 * int(kHalf_mm / kVoxel_mm) + 1;
    const double first = -(n - 1) / 2.0 * kVoxel_mm;
    grid.size = {n, n, n};
    grid.spacing_mm = {kVoxel_mm, kVoxel_mm, kVoxel_mm};
    grid.origin_mm = {first, first, first};
    InsideVolume inside(grid, kOutside);
    for (std::size_t v = 0; v < inside.voxels.size(); ++v)
        if (const Point3 p = grid.pointAt(grid.indexOf(v)); p.z > 0 && !tissue(p))
            inside.voxels[v] = kGas;
    return inside;
}

TEST(SizeOnTheBestPlane, OfHalfABallIsItsDiameterInThePlaneThatStandsUpright)
{
    for (const double radius : {2.5, 4.0, 7.0}) {
        const auto inside = wallWith([&](Point3 p) { return distance(p, {}) < radius; });
        for (const double turn_deg : {0.0, 35.0, 90.0})
            for (const Point3 eye : {Point3{2, 3, 15}, Point3{-12, 9, 6}}) {
                const Vector3 u{std::cos(radians(turn_deg)), std::sin(radians(turn_deg)), 0};
                const auto size = sizeOnBestPlane(inside, Point3{} - u * radius, Point3{} + u * radius, eye);
                ASSERT_TRUE(size) << radius;
                EXPECT_NEAR(size->diameter_mm, 2 * radius, 0.5) << radius;
                EXPECT_NEAR(size->area_mm2, std::numbers::pi * radius * radius / 2, 0.15 * 1.6 * radius * radius);
                EXPECT_NEAR(dot(size->along, u), 1, 1e-9);
                EXPECT_NEAR(dot(size->up, size->along), 0, 1e-9);
                EXPECT_GT(size->up.z, 0.5) << "towards the lumen";
            }
    }
}

TEST(SizeOnTheBestPlane, OfAHeadOnAStalkIsFromFootToTopOrAcrossTheHeadWhicheverIsClicked)
{
    const Point3 head{0, 0, 8};
    const auto inside =
        wallWith([&](Point3 p) { return distance(p, head) < 5 || (p.z < 8 && std::hypot(p.x, p.y) < 2); });
    const auto whole = sizeOnBestPlane(inside, {-2, 0, 0.5}, {2, 0, 0.5}, {3, 1, 16});
    ASSERT_TRUE(whole);
    EXPECT_NEAR(whole->diameter_mm, std::hypot(2, 12.5), 0.7);
    const auto across = sizeOnBestPlane(inside, {-5, 0, 8}, {5, 0, 8}, {3, 1, 16});
    ASSERT_TRUE(across);
    EXPECT_NEAR(across->diameter_mm, 10, 0.7);
    const auto endless = wallWith([](Point3 p) { return std::hypot(p.x, p.y) < 2.5; });
    EXPECT_FALSE(sizeOnBestPlane(endless, {-2.5, 0, 0.3}, {2.5, 0, 0.3}, {3, 1, 16})) << "it has no end";
}

TEST(SizeOnTheBestPlane, IsTheLongOneOfAnEggWhosePlaneLeans)
{
    // Half axes 3 along x, 4 along the leaning axis, 3 across it.
    const Vector3 lean = normalized(Vector3{0, 1, 1}), across{0, -lean.z, lean.y};
    const auto egg = [&](Point3 p) {
        const Vector3 d = p - Point3{};
        return std::hypot(d.x / 3, dot(d, lean) / 8, dot(d, across) / 3) < 1;
    };
    const auto size = sizeOnBestPlane(wallWith(egg), {-3, 0, 0}, {3, 0, 0}, {0, 0, 15});
    ASSERT_TRUE(size);
    EXPECT_GT(dot(size->up, lean), 0.95);
    EXPECT_NEAR(size->diameter_mm, std::hypot(3, 8), 0.8);
}

TEST(SizeOnTheBestPlane, WallThatCurvesUpBesideTheFindingIsNotPartOfIt)
{
    // A tube along y, 12 mm of radius, with half a ball at its bottom.
    const Point3 bottom{0, 0, 0}, axis{0, 0, 12};
    const auto inside =
        wallWith([&](Point3 p) { return std::hypot(p.x - axis.x, p.z - axis.z) > 12 || distance(p, bottom) < 3.5; });
    for (const Vector3 u : {Vector3{1, 0, 0}, Vector3{0, 1, 0}}) {
        const double z = std::abs(u.x) > 0 ? 0.5 : 0;
        const auto size = sizeOnBestPlane(inside, Point3{0, 0, z} - u * 3.5, Point3{0, 0, z} + u * 3.5, axis);
        ASSERT_TRUE(size);
        EXPECT_NEAR(size->diameter_mm, 7, 0.7);
    }
}

TEST(SizeOnTheBestPlane, OfALineThroughTheLumenBetweenTwoFindingsThereIsNone)
{
    const Point3 other{12, 0, 0};
    const auto inside = wallWith([&](Point3 p) { return distance(p, {}) < 4 || distance(p, other) < 2.5; });
    EXPECT_FALSE(sizeOnBestPlane(inside, {-3.7, 0, 1.5}, {14, 0, 1.5}, {5, 0, 15})) << "a calliper in air";
    EXPECT_TRUE(sizeOnBestPlane(inside, {-3.7, 0, 1.5}, {3.7, 0, 1.5}, {5, 0, 15}));
}

TEST(SizeOnTheBestPlane, OfFlatWallOrOfPointsTooFarAsunderThereIsNone)
{
    const auto inside = wallWith([](Point3) { return false; });
    EXPECT_FALSE(sizeOnBestPlane(inside, {-4, 0, 0.5}, {4, 0, 0.5}, {0, 0, 10}));
    EXPECT_FALSE(sizeOnBestPlane(inside, {1, 1, 0}, {1, 1, 0}, {0, 0, 10}));
    EXPECT_FALSE(sizeOnBestPlane(inside, {-50, 0, 0}, {50, 0, 0}, {0, 0, 10}));
}

TEST(SizeOnTheBestPlane, IsReadBackAsItWasKeptAndShownWithTheLumenAbove)
{
    const auto inside = wallWith([&](Point3 p) { return distance(p, {}) < 4; });
    const auto size = sizeOnBestPlane(inside, {-4, 0, 0}, {4, 0, 0}, {0, 0, 15});
    ASSERT_TRUE(size);
    const auto back = planeSizeFromJson(toJson(*size));
    EXPECT_EQ(toJson(back), toJson(*size));
    EXPECT_THROW(planeSizeFromJson("8 mm"), nlohmann::json::exception);
    EXPECT_THROW(planeSizeFromJson({{"diameter_mm", 8}}), nlohmann::json::exception);
    const PlaneView view = viewOf(*size, 300, 200, 40);
    EXPECT_DOUBLE_EQ(view.mm_per_pixel, 0.2);
    EXPECT_LT(view.toPixel({0, 0, 10}).y, 100) << "the lumen is above";
    EXPECT_NEAR(view.toPixel(size->from_mm).y, view.toPixel({-4, 0, 0}).y, 2);
    EXPECT_NEAR(std::abs(view.depth_mm(size->to_mm)), 0, 1e-9);
}

}  // namespace
}  // namespace vicon::viewer
