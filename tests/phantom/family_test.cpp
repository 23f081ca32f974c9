#include <gtest/gtest.h>

#include <cmath>

#include "euler.h"
#include "vicon/phantom/phantom.h"

namespace vicon::phantom {
namespace {

/// The default phantom and its variants at full size. The room itself holds the Euler number against 26 and 6
/// neighbours; here pieces are counted, and what a study promises.
class FullSize : public ::testing::TestWithParam<int> {};

void expectSound(const PhantomOptions& options, const std::string& position)
{
    SCOPED_TRACE("seed " + std::to_string(options.seed) + " " + position);
    NoProgress progress;
    const PhantomScan scan = makeScan(options, position, progress);
    EXPECT_LE(countedPieces(scan.truth.inside), options.gaps + 1);
    // Loops that touch may join the two pieces that a gap lies between.
    EXPECT_GE(countedPieces(scan.truth.inside), options.gaps + (options.self_contact ? 0 : 1));
    EXPECT_EQ(int(scan.truth.gaps.size()), options.gaps);
    EXPECT_EQ(int(scan.truth.polyps.size()), options.polyps);
    EXPECT_GT(scan.truth.length_mm, 1400);
    EXPECT_LT(scan.truth.length_mm, 2000);
    EXPECT_GT(scan.truth.volume_ml, 900);
    EXPECT_LT(scan.truth.volume_ml, 3200);
    EXPECT_GT(scan.truth.fluid_ml, 20);
    EXPECT_NEAR(scan.hu.grid.spacing_mm[0], 0.74, 0.01);
    EXPECT_NEAR(scan.hu.grid.spacing_mm[2], 1, 1e-9);
}

/// Its folds touch by a corner, however often the lumen is rounded off.
TEST(FullSizeOfOneSeed, IsSoundWhereFoldsTouch)
{
    PhantomOptions options;
    options.seed = 402;
    options.thin_walls = true;
    expectSound(options, "HFP");
}

TEST_P(FullSize, IsSoundSupineAndProne)
{
    PhantomOptions options;
    options.seed = std::uint64_t(GetParam());
    expectSound(options, "HFS");
    expectSound(options, "HFP");
}

TEST_P(FullSize, IsSoundInAVariant)
{
    PhantomOptions options;
    options.seed = std::uint64_t(GetParam());
    switch (GetParam() % 5) {
        case 0:
            options.gaps = 2;
            break;
        case 1:
            options.thin_walls = true;
            break;
        case 2:
            options.self_contact = true;
            break;
        case 3:
            options.oblique_deg = 20;
            break;
        default:
            options.low_dose = true;
    }
    expectSound(options, GetParam() % 2 == 0 ? "HFS" : "FFP");
}

INSTANTIATE_TEST_SUITE_P(Seeds, FullSize, ::testing::Range(1, 21));

}  // namespace
}  // namespace vicon::phantom
