#include <gtest/gtest.h>

#include <cstdio>

#include "skeleton_phantom.h"
#include "vicon/steps/resample.h"
#include "vicon/steps/segment.h"
#include "vicon/steps/skeleton.h"

namespace vicon::steps {
namespace {

struct Study {
    std::uint64_t seed;
    const char* position;
    bool thin_walls = false;
};

double diceOf(const InsideVolume& found, const InsideVolume& truth)
{
    double both = 0, of_found = 0, of_truth = 0;
    for (const std::uint8_t v : truth.voxels)
        of_truth += v ? truth.grid.voxelVolume_mm3() : 0;
    const double voxel_mm3 = found.grid.voxelVolume_mm3();
    for (std::size_t n = 0; n < found.voxels.size(); ++n)
        if (found.voxels[n]) {
            of_found += voxel_mm3;
            if (truth.valueOr(truth.grid.indexAt(found.grid.pointAt(found.grid.indexOf(n))), 0))
                both += voxel_mm3;
        }
    return 2 * both / (of_found + of_truth);
}

class FullSize : public testing::TestWithParam<Study> {};

TEST_P(FullSize, PhantomIsFollowedFromRectumToCaecum)
{
    NoProgress progress;
    phantom::PhantomOptions options;
    options.seed = GetParam().seed;
    options.thin_walls = GetParam().thin_walls;
    phantom::PhantomScan scan = phantom::makeScan(options, GetParam().position, progress);
    const HuVolume volume = resample(std::move(scan.hu), {}, progress);
    const Segmentation found = segmentColon(volume, scan.truth.gravity, {}, progress);
    const Skeleton curve = findSkeleton(found.inside, found.plan, {}, progress).curve;
    const auto errors = test::curveErrors(curve, scan.truth);
    std::printf("seed %d %s: dice %.4f, length %+.2f %%, mean %.2f, 95 %% %.2f, worst polyp station %.1f mm\n",
                int(options.seed), GetParam().position, diceOf(found.inside, scan.truth.inside),
                100 * errors.length_fraction, errors.mean_mm, errors.most_mm, errors.worst_polyp_mm);
    EXPECT_GE(diceOf(found.inside, scan.truth.inside), 0.97);
    ASSERT_EQ(found.plan.bridges.size(), scan.truth.gaps.size());
    for (std::size_t n = 0; n < scan.truth.gaps.size(); ++n) {
        // The lumen closes over a few millimetres on both sides of a gap.
        EXPECT_NEAR(found.plan.bridges[n].length_mm, scan.truth.gaps[n].to_mm - scan.truth.gaps[n].from_mm, 10);
        EXPECT_TRUE(found.plan.bridges[n].certain) << found.plan.bridges[n].reason;
    }
    EXPECT_LT(errors.most_mm, 2);
    EXPECT_LT(errors.worst_polyp_mm, 5);
    EXPECT_LT(std::abs(errors.length_fraction), 0.03);
}

INSTANTIATE_TEST_SUITE_P(Seeds, FullSize,
                         testing::Values(Study{1, "HFS"}, Study{2, "HFP"}, Study{3, "HFS"}, Study{4, "HFP"},
                                         Study{5, "HFS"}, Study{6, "HFP"}, Study{1, "HFP"}));

// The halves on both sides of the gap hang together by a hole in the wall between two loops alone.
INSTANTIATE_TEST_SUITE_P(HalvesThatLeak, FullSize, testing::Values(Study{365, "HFS", true}, Study{393, "HFS", true}));

}  // namespace
}  // namespace vicon::steps
