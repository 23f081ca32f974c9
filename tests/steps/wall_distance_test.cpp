#include "vicon/steps/wall_distance.h"

#include <gtest/gtest.h>

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace vicon::steps {
namespace {

NoProgress quiet;

double nearestOutside_mm(const InsideVolume& inside, Index3 v)
{
    double best = 1e9;
    for (int k = -1; k <= inside.grid.size[2]; ++k)
        for (int j = -1; j <= inside.grid.size[1]; ++j)
            for (int i = -1; i <= inside.grid.size[0]; ++i)
                if (inside.valueOr({i, j, k}, kOutside) == kOutside)
                    best = std::min(
                        best, std::hypot((i - v.i) * inside.grid.spacing_mm[0], (j - v.j) * inside.grid.spacing_mm[1],
                                         (k - v.k) * inside.grid.spacing_mm[2]));
    return best;
}

TEST(WallDistance, EqualsTheSearchOfAllOutsideVoxelsOnAnyGrid)
{
    std::mt19937 random(7);
    for (const std::array<double, 3> spacing_mm : {std::array<double, 3>{1, 1, 1}, {0.7, 0.7, 0.7}, {0.6, 0.8, 1.1}}) {
        Grid grid{.size = {19, 14, 17}, .spacing_mm = spacing_mm};
        InsideVolume inside(grid, kGas);
        for (auto& voxel : inside.voxels)
            voxel = random() % 40 == 0 ? kOutside : (random() % 2 ? kGas : kFluid);
        const FieldVolume field = wallDistance(inside, quiet);
        const double half_mm = 0.5 * *std::min_element(spacing_mm.begin(), spacing_mm.end());
        for (std::size_t n = 0; n < grid.voxelCount(); ++n) {
            if (inside.voxels[n])
                ASSERT_NEAR(field.voxels[n], nearestOutside_mm(inside, grid.indexOf(n)) - half_mm, 1e-5);
            else
                ASSERT_EQ(field.voxels[n], 0);
        }
    }
}

TEST(WallDistance, DoesNotDependOnTheNumberOfThreads)
{
    std::mt19937 random(3);
    InsideVolume inside(Grid{.size = {50, 40, 30}});
    HuVolume hu(inside.grid);
    for (std::size_t n = 0; n < inside.voxels.size(); ++n) {
        inside.voxels[n] = random() % 30 == 0 ? kOutside : kGas;
        hu.voxels[n] = std::int16_t(int(random() % 1200) - 1000);
    }
    const auto plain = wallDistance(inside, quiet).voxels, fine = wallDistance(inside, hu, quiet).voxels;
    tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(wallDistance(inside, quiet).voxels, plain);
    EXPECT_EQ(wallDistance(inside, hu, quiet).voxels, fine);
}

TEST(WallDistance, OfASphereIsItsRadiusMinusTheDistanceFromTheCentre)
{
    const double radius_mm = 17.3;
    Grid grid{.size = {56, 56, 56}, .spacing_mm = {0.7, 0.7, 0.7}};
    const Point3 centre = grid.pointAt(ContinuousIndex3{27.3, 27.6, 27.1});
    InsideVolume inside(grid);
    for (std::size_t n = 0; n < grid.voxelCount(); ++n)
        inside.voxels[n] = distance(grid.pointAt(grid.indexOf(n)), centre) < radius_mm ? kGas : kOutside;
    const FieldVolume field = wallDistance(inside, quiet);
    for (std::size_t n = 0; n < grid.voxelCount(); ++n)
        if (inside.voxels[n]) {
            const double expected = radius_mm - distance(grid.pointAt(grid.indexOf(n)), centre);
            ASSERT_NEAR(field.voxels[n], expected, 0.5 * 0.7 * std::sqrt(3.0));
        }
}

/// A blurred ball of gas or fluid in tissue, with the mask at the half level.
struct Ball {
    HuVolume hu;
    InsideVolume inside;
    Point3 centre;
};

Ball blurredBall(double radius_mm, std::uint8_t content)
{
    const Grid grid{.size = {52, 52, 52}, .origin_mm = {5, -3, 2}, .spacing_mm = {0.7, 0.7, 0.7}};
    Ball ball{HuVolume(grid), InsideVolume(grid), grid.pointAt(ContinuousIndex3{25.3, 25.6, 25.1})};
    const double within = content == kGas ? -1000 : 700, tissue = 40;
    for (std::size_t n = 0; n < grid.voxelCount(); ++n) {
        const double beyond_mm = distance(grid.pointAt(grid.indexOf(n)), ball.centre) - radius_mm;
        const double wall = 0.5 * std::erfc(-beyond_mm / (std::sqrt(2.0) * 0.6));
        ball.hu.voxels[n] = std::int16_t(std::lround(within + (tissue - within) * wall));
        ball.inside.voxels[n] = wall < 0.5 ? content : std::uint8_t(kOutside);
    }
    return ball;
}

TEST(WallDistance, WithDensitiesLiesWithinAFractionOfAVoxelOfTheBlurredWall)
{
    const double radius_mm = 15.2, voxel_mm = 0.7;
    for (const std::uint8_t content : {kGas, kFluid}) {
        const Ball ball = blurredBall(radius_mm, content);
        const FieldVolume field = wallDistance(ball.inside, ball.hu, quiet);
        const FieldVolume from_mask = wallDistance(ball.inside, quiet);
        double worst = 0, sum = 0, sum_mask = 0;
        int count = 0;
        for (std::size_t n = 0; n < field.voxels.size(); ++n) {
            if (!ball.inside.voxels[n]) {
                ASSERT_EQ(field.voxels[n], 0);
                continue;
            }
            const double expected = radius_mm - distance(field.grid.pointAt(field.grid.indexOf(n)), ball.centre);
            const double error = std::abs(field.voxels[n] - expected);
            worst = std::max(worst, error);
            sum += error;
            sum_mask += std::abs(from_mask.voxels[n] - expected);
            ++count;
        }
        EXPECT_LT(worst, 0.35 * voxel_mm);
        EXPECT_LT(sum / count, 0.06 * voxel_mm);
        EXPECT_LT(sum / count, 0.5 * sum_mask / count);
    }
}

TEST(WallDistance, OfAnEmptyMaskIsZeroEverywhere)
{
    const FieldVolume field = wallDistance(InsideVolume(Grid{.size = {5, 4, 3}}), quiet);
    for (const float value : field.voxels)
        EXPECT_EQ(value, 0);
}

}  // namespace
}  // namespace vicon::steps
