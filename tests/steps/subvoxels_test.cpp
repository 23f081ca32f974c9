#include "tissue/subvoxels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace vicon::steps {
namespace {

constexpr double kGas_hu = -1000, kTissue_hu = 40, kFluid_hu = 700;

/// The part of a blurred half space at a distance, in voxels, from its face.
double within(double depth)
{
    return 0.5 * std::erfc(-depth / std::sqrt(2.0));
}

class Box : public testing::Test {
protected:
    /// @param tissue the true fraction of it, and fluid of fluid, in the middle of a voxel
    void fill(const std::function<double(int, int)>& tissue, const std::function<double(int, int)>& fluid)
    {
        for (int k = 0; k < Subvoxels::kEdge; ++k)
            for (int j = 0; j < Subvoxels::kEdge; ++j)
                for (int i = 0; i < Subvoxels::kEdge; ++i) {
                    const double t = tissue(i, j), f = fluid(i, j),
                                 hu = t * kTissue_hu + f * kFluid_hu + (1 - t - f) * kGas_hu;
                    // As two materials alone would have it: a film of tissue lies on the fluid.
                    const double two = hu < kTissue_hu ? (hu - kGas_hu) / (kTissue_hu - kGas_hu)
                                                       : (kFluid_hu - hu) / (kFluid_hu - kTissue_hu);
                    box_.at(i, j, k) = {float(hu), float(kFluid_hu), float(two), isSolved(i, j, k)};
                }
        box_.solve();
    }

    static bool isSolved(int i, int j, int k)
    {
        constexpr int kFirst = 6, kLast = Subvoxels::kEdge - 7;
        return std::min({i, j, k}) >= kFirst && std::max({i, j, k}) <= kLast;
    }

    Subvoxels box_{{kGas_hu, kTissue_hu, 0, 1}};
};

TEST_F(Box, TellsThreeMaterialsThatMeetApart)
{
    // A wall that stands upright in a level.
    const auto tissue = [](int i, int) { return within(i - 15.3); };
    fill(tissue, [&](int i, int j) { return (1 - tissue(i, j)) * within(j - 16.2); });
    double worst = 0, sum = 0;
    for (int j = 8; j < 24; ++j)
        for (int i = 8; i < 24; ++i) {
            const double error = std::abs(double(box_.tissue(i, j, 16)) - tissue(i, j));
            worst = std::max(worst, error);
            sum += error;
            EXPECT_TRUE(box_.isExplained(i, j, 16)) << i << ' ' << j;
        }
    EXPECT_LT(sum / (16 * 16), 0.01);
    EXPECT_LT(worst, 0.22) << "the surfaces pull at each other where they meet: by half a voxel";
}

TEST_F(Box, SaysWhatItCannotExplain)
{
    // A sheet of half a voxel in gas: nothing begins as a part of it.
    fill([](int i, int) { return within(i - 15.75) - within(i - 16.25); }, [](int, int) { return 0.0; });
    EXPECT_FALSE(box_.isExplained(16, 16, 16));
    EXPECT_TRUE(box_.isExplained(10, 16, 16));
}

TEST_F(Box, KeepsAWallBelowFluidThatGasIsUnder)
{
    // Gas, fluid, a wall of 1.6 voxels and gas again, on the way down.
    const auto tissue = [](int, int j) { return within(j - 16.2) - within(j - 17.8); };
    fill(tissue, [](int, int j) { return within(j - 13.5) - within(j - 16.2); });
    EXPECT_GT(std::max(box_.tissue(16, 17, 16), box_.tissue(16, 16, 16)), 0.35F);
}

}  // namespace
}  // namespace vicon::steps
