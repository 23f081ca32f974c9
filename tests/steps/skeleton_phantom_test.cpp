#include <gtest/gtest.h>

#include "skeleton_phantom.h"
#include "vicon/steps/skeleton.h"

namespace vicon::steps {
namespace {

TEST(PhantomSkeleton, LiesOnTheTrueCurveDespiteFoldsPolypsAndRectalTube)
{
    NoProgress progress;
    phantom::PhantomOptions options;
    options.seed = 5;
    options.size = {256, 256, 288};
    options.spacing_mm = {1.5, 1.5, 1.5};
    options.gaps = 0;
    const auto truth = phantom::makeScan(options, "HFS", progress).truth;
    const LumenPlan plan = planForMask(truth.inside);
    ASSERT_EQ(plan.pieces.size(), 1U);
    const Skeleton curve = findSkeleton(truth.inside, plan, {}, progress).curve;
    for (const SkeletonPiece& piece : curve.pieces)
        for (const SkeletonPoint& p : piece.points)
            EXPECT_NE(truth.inside.valueOr(truth.inside.grid.indexAt(p.position_mm), kOutside), kOutside)
                << "at station " << p.station_mm;
    const auto errors = test::curveErrors(curve, truth);
    RecordProperty("mean_mm", std::to_string(errors.mean_mm));
    EXPECT_LT(errors.mean_mm, 0.6);
    EXPECT_LT(errors.most_mm, 1.5);
    EXPECT_LT(errors.worst_polyp_mm, 5);
    EXPECT_LT(std::abs(errors.length_fraction), 0.02);
}

}  // namespace
}  // namespace vicon::steps
