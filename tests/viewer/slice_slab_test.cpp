#include "vicon/viewer/model/slice_slab.h"

#include <gtest/gtest.h>

#include <random>

#include "test_colon.h"
#include "vicon/viewer/model/slice_image.h"

namespace vicon::viewer {
namespace {

constexpr int kWidth = 90;  // planes of the volume, more than a slab holds

HuVolume noise(const test::Storage& storage, int width = kWidth)
{
    Grid grid;
    grid.size = {width, 37, 21};
    grid.spacing_mm = {1.5, 0.7, 2};
    grid.axis = storage.axis;
    grid.origin_mm = {12, -30, 5};
    HuVolume volume(grid);
    std::mt19937 random(3);
    std::uniform_int_distribution<int> density(-1000, 1000);
    for (std::int16_t& voxel : volume.voxels)
        voxel = std::int16_t(density(random));
    return volume;
}

/// The picture of a plane across the volume's first axis; its edges lie outside.
PlaneView viewOf(const Grid& grid, double plane)
{
    return {grid.pointAt(ContinuousIndex3{plane, 18, 10}), grid.axis[1], grid.axis[2], 0.9, 60, 70};
}

TEST(SliceSlab, ShowsThePlanesThatItHoldsAsTheVolumeShowsThem)
{
    for (const test::Storage& storage : test::storages())
        for (const double around : {0.0, 3.2, 44.6, 88.7}) {
            const HuVolume volume = noise(storage);
            const SliceSlab slab(volume, around);
            int held = 0;
            for (double plane = -0.4; plane < kWidth - 0.5; plane += 0.3) {
                const PlaneView view = viewOf(volume.grid, plane);
                const auto found = SliceSlab::planeOf(volume.grid, view);
                ASSERT_TRUE(found) << storage.name;
                ASSERT_NEAR(*found, plane, 1e-9);
                if (!slab.holds(plane))
                    continue;
                ++held;
                const auto wanted = sliceDensities(volume, view), shown = sliceDensities(slab.volume(), view);
                for (std::size_t n = 0; n < wanted.size(); ++n)
                    ASSERT_NEAR(shown[n], wanted[n], 1e-3) << storage.name << ", plane " << plane;
            }
            EXPECT_TRUE(slab.holds(around));
            EXPECT_GT(held, 100);
            EXPECT_LT(held, 115);
        }
}

TEST(SliceSlab, HoldsAllOfAVolumeThatIsSmaller)
{
    const HuVolume volume = noise(test::storages().front(), 9);
    const SliceSlab slab(volume, 4);
    EXPECT_TRUE(slab.holds(-0.4));
    EXPECT_TRUE(slab.holds(8.4));
    EXPECT_EQ(slab.volume().voxels.size(), volume.voxels.size());
}

TEST(SliceSlab, IsForPlanesAcrossTheFirstAxisAlone)
{
    const Grid grid = noise(test::storages().front()).grid;
    PlaneView view = viewOf(grid, 20);
    EXPECT_TRUE(SliceSlab::planeOf(grid, view));
    view.right = grid.axis[0];
    EXPECT_FALSE(SliceSlab::planeOf(grid, view));
    view.right = normalized(grid.axis[1] + grid.axis[0] * 0.01);
    EXPECT_FALSE(SliceSlab::planeOf(grid, view));
}

}  // namespace
}  // namespace vicon::viewer
