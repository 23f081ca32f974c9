#include "vicon/viewer/model/circled_wall.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test_colon.h"

namespace vicon::viewer {
namespace {

constexpr double kVoxel_mm = 0.8, kThick_mm = 3, kFatHu = -95;

/// Gas above a wall of 3 mm with fat behind it, and what stands on the wall: half a ball, of tissue or of fat.
struct Wall {
    HuVolume volume;
    InsideVolume inside;
    FieldVolume wall_distance;

    Wall(double radius_mm, double ball_hu)
        : volume(Grid{
              .size = {50, 50, 50}, .origin_mm = {-20, -20, -20}, .spacing_mm = {kVoxel_mm, kVoxel_mm, kVoxel_mm}}),
          inside(volume.grid)
    {
        for (std::size_t n = 0; n < volume.voxels.size(); ++n) {
            const Point3 p = volume.grid.pointAt(volume.grid.indexOf(n));
            const bool ball = p.z < 0 && std::hypot(p.x, p.y, p.z) < radius_mm;
            const double hu = ball ? ball_hu : p.z < 0 ? -1000 : p.z < kThick_mm ? 40 : kFatHu;
            volume.voxels[n] = std::int16_t(hu);
            inside.voxels[n] = hu < -900 ? kGas : kOutside;
        }
        wall_distance = test::wallDistanceOf(inside);
    }
    std::optional<CircledWall> circled(Point3 middle, double radius_mm) const
    {
        return circledWall(Lumen(inside, wall_distance), middle, radius_mm);
    }
    DensitySample sampled(Point3 middle, double radius_mm) const
    {
        return sampleDensity(volume, inside, middle, radius_mm, circled(middle, radius_mm));
    }
};

TEST(CircledWall, OfABareWallIsItsSurfaceAndStandsUpOverNothing)
{
    const auto wall = Wall(0, 0).circled({0, 0, 1.5}, 4);
    ASSERT_TRUE(wall);
    EXPECT_NEAR(wall->surface_mm.z, 0, kVoxel_mm);
    EXPECT_NEAR(wall->inwards.z, 1, 0.05);
    EXPECT_LT(wall->raised_mm, kVoxel_mm);
}

TEST(CircledWall, OfAFindingStandsUpAsHighAsItIs)
{
    const auto wall = Wall(5, 40).circled({0, 0, -3}, 6);
    ASSERT_TRUE(wall);
    EXPECT_NEAR(wall->raised_mm, 5, 1.5 * kVoxel_mm);
    const auto deep = Wall(5, 40).circled({0, 0, -3}, 3);
    ASSERT_TRUE(deep);
    EXPECT_NEAR(deep->raised_mm, 5, 1.5 * kVoxel_mm) << "as high as the finding, though the circle lies in it";
}

TEST(CircledWall, IsNoneWhereTheCircleDoesNotReachTheLumen)
{
    EXPECT_FALSE(Wall(0, 0).circled({0, 0, 10}, 4));
}

TEST(CircledWall, LetsNoFatBehindABareWallBeTakenButAFattyFindingAndFatThatIsCircledAlone)
{
    EXPECT_EQ(Wall(0, 0).sampled({0, 0, 1.5}, 4).voxels, 0U);
    EXPECT_EQ(Wall(0, 0).sampled({0, 0, 2.5}, 2).voxels, 0U) << "half of it wall, and of that the margin";
    const DensitySample lipoma = Wall(6, kFatHu).sampled({0, 0, -3.5}, 4);
    ASSERT_GT(lipoma.voxels, 0U);
    EXPECT_NEAR(lipoma.mean_hu, kFatHu, 15) << "and a little of the wall";
    const DensitySample polyp = Wall(6, 40).sampled({0, 0, -2.5}, 5);
    ASSERT_GT(polyp.voxels, 0U);
    EXPECT_NEAR(polyp.mean_hu, 40, 1);
    const DensitySample fat = Wall(0, 0).sampled({0, 0, 10}, 4);
    ASSERT_GT(fat.voxels, 0U);
    EXPECT_NEAR(fat.mean_hu, kFatHu, 1);
}

}  // namespace
}  // namespace vicon::viewer
