// Bone that a pool touches without a wall between: what floods out of the scan is cut off.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "segment/fluid/fluid.h"

namespace vicon::steps {
namespace {

constexpr std::int16_t kBoneMarrow_hu = 320, kPool_hu = 450, kWall_hu = 40, kAir_hu = -1000;
constexpr int kLength = 160, kLevel_j = 14, kBottom_j = 22;

/// A closed channel along the scan, half full of tagged fluid, in tissue; under its middle a spine that runs through
/// the scan, up to the pool or a wall's thickness away from it.
struct PoolOverSpine {
    HuVolume hu{Grid{.size = {40, 60, kLength}, .spacing_mm = {1, 1, 1}}, kWall_hu};
    InsideVolume labels{hu.grid, kOutside};

    /// @param jagged a spine whose rows, four by four, end where the next ones begin
    explicit PoolOverSpine(int apart_voxels, bool pool_leaves = false, bool jagged = false)
    {
        for (int k = 0; k < kLength; ++k)
            for (int j = 0; j < hu.grid.size[1]; ++j)
                for (int i = 0; i < hu.grid.size[0]; ++i) {
                    const bool in_channel =
                        i >= 10 && i < 30 && j >= 6 && j < kBottom_j && (pool_leaves || (k >= 50 && k < 110));
                    if (in_channel)
                        hu.at({i, j, k}) = j < kLevel_j ? kAir_hu : kPool_hu;
                    else if (i >= 8 && i < 32 && j >= kBottom_j + apart_voxels && j < 50 &&
                             (!jagged || k % 8 == 1 || (i < 20) == (j / 4 % 2 == 0)))
                        hu.at({i, j, k}) = kBoneMarrow_hu;
                    if (in_channel && j < kLevel_j)
                        labels.at({i, j, k}) = kGas;
                }
    }

    FluidResult flood()
    {
        NoProgress quiet;
        return addTaggedFluid(hu, {0, 1, 0}, {.fluid_above_hu = 200}, labels, quiet);
    }

    int labelled(int from_j, int to_j) const
    {
        int count = 0;
        for (int k = 0; k < kLength; ++k)
            for (int j = from_j; j < to_j; ++j)
                for (int i = 0; i < hu.grid.size[0]; ++i)
                    count += labels.at({i, j, k}) == kFluid ? 1 : 0;
        return count;
    }
};

TEST(FluidRunaway, SpineThatAPoolTouchesIsCutOffAndTold)
{
    PoolOverSpine scan(0);
    const FluidResult found = scan.flood();
    const int pool = 20 * (kBottom_j - kLevel_j) * 60, spine = 24 * 28 * kLength;
    EXPECT_GE(scan.labelled(kLevel_j, kBottom_j), 0.98 * pool);
    EXPECT_LE(scan.labelled(kBottom_j, 60), 0.06 * spine) << "but for the rim of blur";
    EXPECT_NEAR(found.runaway_ml, 0.97 * spine / 1000, 0.03 * spine / 1000);
}

TEST(FluidRunaway, SpineIsCutOffWhateverItsRowsAreLike)
{
    constexpr int kBelowRim_j = kBottom_j + 8;
    for (const bool jagged : {false, true}) {
        PoolOverSpine scan(0, false, jagged);
        EXPECT_GT(scan.flood().runaway_ml, 30);
        EXPECT_EQ(scan.labelled(kBelowRim_j, 60), 0) << jagged;
    }
}

TEST(FluidRunaway, NothingIsCutOffWhereAWallPartsThem)
{
    PoolOverSpine scan(2);
    EXPECT_EQ(scan.flood().runaway_ml, 0);
    EXPECT_EQ(scan.labelled(kBottom_j, 60), 0);
}

TEST(FluidRunaway, APoolThatTheScanEndsInStays)
{
    PoolOverSpine scan(2, true);
    const FluidResult found = scan.flood();
    EXPECT_EQ(found.runaway_ml, 0);
    EXPECT_GE(scan.labelled(kLevel_j, kBottom_j), 0.98 * 20 * (kBottom_j - kLevel_j) * kLength);
}

}  // namespace
}  // namespace vicon::steps
