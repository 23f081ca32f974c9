#include "vicon/steps/wall_distance.h"

#include <gtest/gtest.h>

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

TEST(WallDistance, OfAnEmptyMaskIsZeroEverywhere)
{
    const FieldVolume field = wallDistance(InsideVolume(Grid{.size = {5, 4, 3}}), quiet);
    for (const float value : field.voxels)
        EXPECT_EQ(value, 0);
}

}  // namespace
}  // namespace vicon::steps
