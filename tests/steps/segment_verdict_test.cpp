// What a person is told: scans without a colon, colons cut by the field of view, and what a person says in turn.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "body_shapes.h"
#include "segment_shapes.h"
#include "vicon/core/error.h"
#include "vicon/phantom/phantom.h"
#include "vicon/steps/resample.h"
#include "vicon/steps/segment.h"

namespace vicon::steps {
namespace {

using test::blurred;
using test::centredGrid;
using test::TubeScan;
using testing::HasSubstr;

const Grid kGrid = centredGrid({110, 80, 120}, 1.5);

Segmentation segment(const HuVolume& volume, const SegmentOptions& options = {})
{
    NoProgress progress;
    return segmentColon(volume, {0, 1, 0}, options, progress);
}

HuVolume drawn(double (*density)(Point3))
{
    HuVolume volume(kGrid, -1000);
    for (std::size_t n = 0; n < volume.voxels.size(); ++n)
        volume.voxels[n] = std::int16_t(std::lround(density(kGrid.pointAt(kGrid.indexOf(n)))));
    return volume;
}

TEST(Verdict, ChestHasNoColon)
{
    const Segmentation result = segment(drawn(test::chestHu));
    EXPECT_EQ(result.verdict, Verdict::absent) << result.reason;
    EXPECT_FALSE(result.reason.empty());
}

TEST(Verdict, HeadHasNoColon)
{
    const Segmentation result = segment(drawn(test::headHu));
    EXPECT_EQ(result.verdict, Verdict::absent) << result.reason;
    EXPECT_FALSE(result.reason.empty());
}

TEST(Verdict, NeckKneesWaterAndAnEmptyScannerHaveNoColon)
{
    const struct {
        const char* name;
        double (*density)(Point3);
    } scans[] = {{"neck", test::neckHu}, {"knees", test::kneesHu}, {"water", test::waterHu}, {"empty", test::emptyHu}};
    for (const auto& [name, density] : scans) {
        const Segmentation result = segment(drawn(density));
        EXPECT_EQ(result.verdict, Verdict::absent) << name << ": " << result.reason;
        EXPECT_FALSE(result.reason.empty()) << name;
    }
}

TEST(Verdict, AColonThatTheEndOfTheScanCutsIsUnsureAndSaysSo)
{
    TubeScan scan{.line = {{0, 15, -70}, {0, 15, -45}, {45, 0, -40}, {45, 0, 100}, {-45, 0, 100}, {-45, 0, -40}}};
    const Segmentation result = segment(scan.draw(kGrid));
    EXPECT_EQ(result.verdict, Verdict::unsure);
    EXPECT_LT(result.confidence, 0.5);
    EXPECT_THAT(result.reason, HasSubstr("beyond the end of the scan"));
}

TEST(Verdict, AStumpOfAColonIsTooLittleAndTheReasonSaysThatTheScanCutsIt)
{
    TubeScan scan{.line = {{-30, 0, 60}, {-30, 0, 100}}, .second_line = {{30, 10, 50}, {30, 10, 100}}};
    const Segmentation result = segment(scan.draw(kGrid));
    EXPECT_EQ(result.verdict, Verdict::absent);
    EXPECT_LT(result.confidence, 0.6);
    EXPECT_THAT(result.reason, HasSubstr("beyond the end of the scan"));
}

TEST(Verdict, AColonThatTheFieldOfViewCutsAtTheSidesIsNotTakenForWhole)
{
    NoProgress progress;
    phantom::PhantomOptions options;
    options.seed = 3;
    options.gaps = 0;
    options.folds = false;
    options.size = {120, 120, 134};
    options.spacing_mm = {2, 2, 3.25};
    phantom::PhantomScan scan = phantom::makeScan(options, "HFS", progress);
    const HuVolume volume = resample(std::move(scan.hu), {}, progress);
    const Segmentation result = segmentColon(volume, scan.truth.gravity, {}, progress);
    EXPECT_EQ(result.verdict, Verdict::unsure) << result.reason;
    EXPECT_THAT(result.reason, HasSubstr("the field of view cuts the body"));
}

TEST(Verdict, AVolumeThatDoesNotFitIntoMemoryIsAnErrorWithARemedy)
{
    NoProgress progress;
    ResampleOptions options;
    options.spacing_mm = 0.01;
    HuVolume volume(centredGrid({64, 64, 64}, 5), 40);
    try {
        (void)resample(std::move(volume), options, progress);
        FAIL() << "a volume of 32000 x 32000 x 32000 voxels";
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::no_memory);
        EXPECT_FALSE(e.remedy().empty());
    }
}

/// A colon with a bubble of 1.4 ml beside its far end, too small to be taken, and a pool of fluid without gas.
struct Correctable {
    TubeScan scan{.line = {{0, 15, -70}, {0, 15, -45}, {45, 0, -40}, {45, 0, 45}, {-45, 0, 45}, {-45, 0, -20}}};
    Point3 bubble{-45, 0, -55}, pool{0, -20, 0}, nothing{0, 30, 30};

    HuVolume draw() const
    {
        HuVolume volume = scan.draw(kGrid);
        for (std::size_t n = 0; n < volume.voxels.size(); ++n) {
            const Point3 p = kGrid.pointAt(kGrid.indexOf(n));
            const double gas = 1 - blurred(distance(p, bubble) - 7, 0.7),
                         fluid = 1 - blurred(distance(p, pool) - 9, 0.7);
            const double hu = volume.voxels[n] + (-1000 - volume.voxels[n]) * gas;
            volume.voxels[n] = std::int16_t(std::lround(hu + (600 - hu) * fluid));
        }
        return volume;
    }
    static bool holds(const Segmentation& s, Point3 p)
    {
        return s.inside.valueOr(s.inside.grid.indexAt(p), kOutside) != kOutside;
    }
};

TEST(Correction, APointAddsWhatIsTooSmallToBeTakenAlone)
{
    const Correctable colon;
    const HuVolume volume = colon.draw();
    EXPECT_FALSE(Correctable::holds(segment(volume), colon.bubble));
    SegmentOptions options;
    options.add = {colon.bubble};
    const Segmentation result = segment(volume, options);
    EXPECT_TRUE(Correctable::holds(result, colon.bubble));
    EXPECT_EQ(result.plan.pieces.size(), 2U);
}

TEST(Correction, APointAddsFluidThatNoGasLiesAbove)
{
    const Correctable colon;
    const HuVolume volume = colon.draw();
    EXPECT_FALSE(Correctable::holds(segment(volume), colon.pool));
    SegmentOptions options;
    options.add = {colon.pool};
    const Segmentation result = segment(volume, options);
    EXPECT_TRUE(Correctable::holds(result, colon.pool));
    EXPECT_EQ(result.inside.valueOr(result.inside.grid.indexAt(colon.pool), kOutside), kFluid);
}

TEST(Correction, AnAddedPointInTissueIsReported)
{
    const Correctable colon;
    SegmentOptions options;
    options.add = {colon.nothing};
    EXPECT_THAT(segment(colon.draw(), options).reason, HasSubstr("no gas or fluid at the added point 0,30,30"));
}

TEST(Correction, ACutDropsTheSmallerPart)
{
    const Correctable colon;
    SegmentOptions options;
    options.cut = {{-45, 0, 12}};
    const Segmentation result = segment(colon.draw(), options);
    EXPECT_TRUE(Correctable::holds(result, {45, 0, 0}));
    EXPECT_TRUE(Correctable::holds(result, {-20, 0, 45}));
    EXPECT_FALSE(Correctable::holds(result, {-45, 0, -15}));
}

/// Wherever in the lumen it is clicked: beside the wall, in a bend, in a wide place, a little outside.
TEST(Correction, ACutTakesTheWholeCrossSectionAway)
{
    const TubeScan scan{.line = {{0, 15, -70}, {0, 15, -45}, {45, 0, -40}, {45, 0, 45}, {-45, 0, 45}, {-45, 0, -20}},
                        .second_line = {{-45, -12, 22}, {-45, -12, 8}}};  // a sac beside the last limb
    const HuVolume volume = scan.draw(kGrid);
    const Segmentation whole = segment(volume);
    ASSERT_EQ(whole.plan.pieces.size(), 1U);
    for (const Point3 at : {Point3{-45, 0, 12}, Point3{-40, 0, 12}, Point3{-54, 1, 12}, Point3{-45, 9, 10},
                            Point3{-45, -17, 14}, Point3{-38, 3, 0}, Point3{-44, 0, -3}, Point3{-32.5, 0, -4}}) {
        SegmentOptions options;
        options.cut = {at};
        const Segmentation result = segment(volume, options);
        EXPECT_TRUE(Correctable::holds(result, {45, 0, 0})) << at.x << ", " << at.y;
        EXPECT_TRUE(Correctable::holds(result, {-20, 0, 45})) << at.x << ", " << at.y;
        EXPECT_FALSE(Correctable::holds(result, {-45, 0, -15})) << at.x << ", " << at.y;
    }
}

TEST(Correction, ADroppedPieceIsLeftOut)
{
    TubeScan scan{.line = {{0, 15, -70}, {0, 15, -45}, {45, 0, -40}, {45, 0, 45}, {-45, 0, 45}, {-45, 0, 15}},
                  .second_line = {{-45, 0, -20}, {-45, 0, -60}}};
    const HuVolume volume = scan.draw(kGrid);
    ASSERT_EQ(segment(volume).plan.pieces.size(), 2U);
    SegmentOptions options;
    options.drop = {{-45, 0, -40}};
    const Segmentation result = segment(volume, options);
    EXPECT_EQ(result.plan.pieces.size(), 1U);
    EXPECT_FALSE(Correctable::holds(result, {-45, 0, -40}));
}

}  // namespace
}  // namespace vicon::steps
