// What gas leaks through from one loop into the next: holes of walls that the scan hardly shows.
#include <gtest/gtest.h>

#include <algorithm>

#include "segment/wall/leaks.h"

namespace vicon::steps {
namespace {

constexpr double kVoxel_mm = 0.7;
constexpr int kWall_i = 20;  // layers of the wall between the channels: this one and the next

/// Two channels of gas, 16 voxels wide, side by side with a wall between them.
struct Channels {
    HuVolume hu{Grid{.size = {42, 20, 60}, .spacing_mm = {kVoxel_mm, kVoxel_mm, kVoxel_mm}}, 40};
    InsideVolume labels{hu.grid, kOutside};

    Channels()
    {
        fill({4, 2, 2}, {kWall_i, 18, 58}, -1000);
        fill({kWall_i + 2, 2, 2}, {38, 18, 58}, -1000);
    }

    void fill(Index3 from, Index3 to, std::int16_t density)
    {
        for (int k = from.k; k < to.k; ++k)
            for (int j = from.j; j < to.j; ++j)
                for (int i = from.i; i < to.i; ++i) {
                    hu.at({i, j, k}) = density;
                    labels.at({i, j, k}) = kGas;
                }
    }

    bool joined() const
    {
        for (int k = 0; k < hu.grid.size[2]; ++k)
            for (int j = 0; j < hu.grid.size[1]; ++j)
                if (labels.at({kWall_i, j, k}) != kOutside && labels.at({kWall_i + 1, j, k}) != kOutside)
                    return true;
        return false;
    }
};

TEST(Leaks, AreClosedAlsoWhereTheyAreTheOnlyWay)
{
    for (const std::int16_t density : {std::int16_t(-500), std::int16_t(-750)}) {
        Channels channels;
        channels.fill({kWall_i, 8, 28}, {kWall_i + 2, 11, 31}, density);
        const auto leaks = closeLeaks(channels.hu, {}, channels.labels);
        ASSERT_EQ(leaks.size(), 1U) << density;
        EXPECT_FALSE(channels.joined());
        EXPECT_LT(distance(leaks[0], channels.hu.grid.pointAt(ContinuousIndex3{kWall_i + 0.5, 9, 29})), kVoxel_mm);
    }
}

TEST(Leaks, AreNoneWhereThePassageIsOpenOrTheWallIsWhole)
{
    Channels open;
    open.fill({kWall_i, 8, 28}, {kWall_i + 2, 12, 32}, -1000);
    EXPECT_TRUE(closeLeaks(open.hu, {}, open.labels).empty());
    EXPECT_TRUE(open.joined());
    Channels whole;
    const InsideVolume before = whole.labels;
    EXPECT_TRUE(closeLeaks(whole.hu, {}, whole.labels).empty());
    EXPECT_EQ(whole.labels.voxels, before.voxels);
}

TEST(Leaks, OfFluidAreLeftToItsRim)
{
    Channels pools;
    pools.fill({kWall_i, 8, 28}, {kWall_i + 2, 11, 31}, -500);
    std::replace(pools.labels.voxels.begin(), pools.labels.voxels.end(), std::uint8_t(kGas), std::uint8_t(kFluid));
    const InsideVolume before = pools.labels;
    EXPECT_TRUE(closeLeaks(pools.hu, {}, pools.labels).empty());
    EXPECT_EQ(pools.labels.voxels, before.voxels);
}

}  // namespace
}  // namespace vicon::steps
