// One patient, acquired with slices across the body and with slices turned about the left-right axis. The two
// truths, on different voxels, agree no better than 0.992 to 0.993.
#include "oblique.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace vicon::test {
namespace {

struct Acquisition {
    std::uint64_t seed;
    const char* position;
    double degrees;
    bool fluid;
};

class Oblique : public testing::TestWithParam<Acquisition> {};

TEST_P(Oblique, AcquisitionGivesTheSameColon)
{
    const auto [seed, position, degrees, fluid] = GetParam();
    constexpr double voxel_mm = 0.75;
    phantom::PhantomOptions options;
    options.seed = seed;
    options.gaps = 0;
    options.fluid = fluid;
    options.spacing_mm = {voxel_mm, voxel_mm, voxel_mm};
    options.size = {int(380 / voxel_mm), int(440 / voxel_mm), int(500 / voxel_mm)};
    const Difference found = obliqueDifference(options, position, degrees);
    std::printf(
        "seed %d %s %g degrees, %s: dice %.4f (truths %.4f; axial to truth %.4f, oblique to truth %.4f), "
        "curve mean %.2f, 95 %% %.2f mm, length %+.2f %%\n",
        int(seed), position, degrees, fluid ? "fluid" : "dry", found.dice, found.truth_dice, found.straight_dice,
        found.oblique_dice, found.curve_mean_mm, found.curve_most_mm, 100 * found.length_fraction);
    EXPECT_GE(found.dice, 0.99);
    EXPECT_LE(found.curve_mean_mm, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Oblique,
                         testing::Values(Acquisition{11, "HFS", 20, true}, Acquisition{12, "HFP", -20, true},
                                         Acquisition{12, "HFP", -20, false}, Acquisition{13, "FFS", 10, true}));

}  // namespace
}  // namespace vicon::test
