#include "vicon/steps/quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "vicon/phantom/phantom.h"
#include "vicon/steps/colon_parts.h"
#include "vicon/steps/noise.h"
#include "vicon/steps/resample.h"

namespace vicon::steps {
namespace {

/// A straight tube along z with a radius of 15 mm, 1200 mm long on voxels of 2 mm.
struct Tube {
    InsideVolume inside{Grid{.size = {28, 28, 610}, .spacing_mm = {2, 2, 2}}};
    Skeleton skeleton;

    /// Collapsed between two heights, filled with fluid below another.
    explicit Tube(double collapsed_from_mm = 0, double collapsed_to_mm = 0, double fluid_to_mm = 0)
    {
        for (std::size_t n = 0; n < inside.voxels.size(); ++n) {
            const Point3 p = inside.grid.pointAt(inside.grid.indexOf(n));
            if (std::hypot(p.x - 27, p.y - 27) < 15 && p.z > 9 && p.z < 1210 &&
                (p.z < collapsed_from_mm || p.z > collapsed_to_mm))
                inside.voxels[n] = p.z < fluid_to_mm ? kFluid : kGas;
        }
        const auto piece = [&](bool bridge, double from_mm, double to_mm) {
            SkeletonPiece out{bridge, {}};
            for (double z = from_mm; z <= to_mm; z += 1)
                out.points.push_back({{27, 27, z}, z - 10, bridge ? 0.0 : 15.0});
            skeleton.pieces.push_back(out);
        };
        if (collapsed_to_mm == 0) {
            piece(false, 10, 1210);
            return;
        }
        piece(false, 10, collapsed_from_mm);
        piece(true, collapsed_from_mm, collapsed_to_mm);
        piece(false, collapsed_to_mm, 1210);
    }
    ScanQuality measure(const ColonPartRanges& parts = {})
    {
        NoProgress progress;
        return measureQuality(inside, skeleton, parts, 0, {}, {}, progress);
    }
};

TEST(Quality, OfATubeIsItsRadiusAndVolume)
{
    const ScanQuality q = Tube().measure();
    EXPECT_NEAR(q.whole.median_radius_mm, 15, 0.3);
    EXPECT_NEAR(q.whole.volume_ml, 1.2 * std::numbers::pi * 225, 0.03 * 848);  // a disc of such voxels is 2.7 % small
    EXPECT_EQ(q.whole.fluid_ml, 0);
    EXPECT_EQ(q.whole.collapsed_mm, 0);
    EXPECT_TRUE(q.whole.adequate);
    EXPECT_EQ(q.reason, "");
}

TEST(Quality, MottledTaggingIsCountedInThePartWhereItLiesAndTold)
{
    const ColonPartRanges parts{{ColonPart::rectum, 0, 400}, {ColonPart::sigmoid, 400, 1200}};
    Tube tube;
    NoProgress progress;
    MottledTagging mottled{.block_mm = 4, .blocks_mm = {{27, 20, 110}}, .shares = {1}};
    for (double z = 510; z < 550; z += 4)
        mottled.add({27, 20, z}, 1);
    const ScanQuality q = measureQuality(tube.inside, tube.skeleton, parts, 0, {mottled, {}}, {}, progress);
    EXPECT_NEAR(q.parts[0].mottled_ml, 0.064, 1e-9);
    EXPECT_NEAR(q.parts[1].mottled_ml, 0.64, 1e-9);
    EXPECT_NEAR(q.whole.mottled_ml, 0.704, 1e-9);
    EXPECT_TRUE(q.whole.adequate) << "it is read with care, not anew";
    EXPECT_EQ(q.reason, "0.6 ml of stool or mottled tagging, sigmoid");
}

TEST(Quality, FluidIsCountedInThePartWhereItLies)
{
    const ColonPartRanges parts{{ColonPart::rectum, 0, 400}, {ColonPart::sigmoid, 400, 1200}};
    const ScanQuality q = Tube(0, 0, 210).measure(parts);
    EXPECT_NEAR(q.parts[0].fluid_ml, 0.2 * std::numbers::pi * 225, 4);
    EXPECT_EQ(q.parts[1].fluid_ml, 0);
    EXPECT_NEAR(q.whole.fluid_ml, q.parts[0].fluid_ml, 1e-9);
    EXPECT_NEAR(q.whole.volume_ml, q.parts[0].volume_ml + q.parts[1].volume_ml, 1);
}

TEST(Quality, AlongTheTubeIsItsRadiusItsFluidAndItsGap)
{
    const LumenAlong along = Tube(800, 840, 210).measure().along;
    ASSERT_EQ(along.radius_mm.size(), along.fluid_fraction.size());
    EXPECT_NEAR(double(along.radius_mm.size()) * along.step_mm, 1200, along.step_mm + 1);
    const auto at = [&](const std::vector<double>& values, double station_mm) {
        return values.at(std::size_t(station_mm / along.step_mm));
    };
    for (const double station_mm : {100, 400, 700, 1000}) {
        EXPECT_NEAR(at(along.radius_mm, station_mm), 15, 0.5) << station_mm;
        EXPECT_EQ(at(along.fluid_fraction, station_mm), station_mm < 200 ? 1 : 0) << station_mm;
    }
    EXPECT_EQ(at(along.radius_mm, 810), 0);
    ASSERT_EQ(along.collapsed.size(), 1u);
    EXPECT_NEAR(along.collapsed[0].from_mm, 790, 2);
    EXPECT_NEAR(along.collapsed[0].to_mm, 830, 2);
}

struct Collapse {
    double length_mm;
    bool adequate;
};

class CollapsedTube : public testing::TestWithParam<Collapse> {};

TEST_P(CollapsedTube, IsAdequateUnlessTheCollapseCouldHideALesionOf10Mm)
{
    const double length_mm = GetParam().length_mm;
    const ColonPartRanges parts{{ColonPart::rectum, 0, 600}, {ColonPart::sigmoid, 600, 1200}};
    const ScanQuality q = Tube(800, 800 + length_mm).measure(parts);
    EXPECT_NEAR(q.parts[1].longest_collapsed_mm, length_mm, 2);
    EXPECT_NEAR(q.parts[1].collapsed_mm, length_mm, 2);
    EXPECT_TRUE(q.parts[0].adequate);
    EXPECT_EQ(q.parts[1].adequate, GetParam().adequate);
    EXPECT_EQ(q.whole.adequate, GetParam().adequate);
    EXPECT_EQ(q.reason.find("sigmoid collapsed") != std::string::npos, !GetParam().adequate);
}

INSTANTIATE_TEST_SUITE_P(Lengths, CollapsedTube,
                         testing::Values(Collapse{6, true}, Collapse{14, false}, Collapse{40, false}));

TEST(Quality, ACollapseAcrossABorderOfPartsIsToldOfOne)
{
    for (const double border_mm : {797.5, 800.0}) {  // the collapse lies at 790 to 806 mm
        const ColonPartRanges parts{{ColonPart::rectum, 0, border_mm}, {ColonPart::sigmoid, border_mm, 1200}};
        const ScanQuality q = Tube(800, 816).measure(parts);
        EXPECT_FALSE(q.whole.adequate);
        EXPECT_NE(q.parts[0].adequate, q.parts[1].adequate) << border_mm;
        EXPECT_NE(q.reason.find("collapsed"), std::string::npos) << q.reason;
        EXPECT_NEAR(q.whole.longest_collapsed_mm, 16, 2);
    }
}

TEST(Quality, EachMillimetreBelongsToOnePart)
{
    const ColonPartRanges parts{{ColonPart::rectum, 0, 400.4}, {ColonPart::sigmoid, 400.4, 1200}};
    const ScanQuality q = Tube().measure(parts);
    EXPECT_NEAR(q.parts[0].volume_ml + q.parts[1].volume_ml, q.whole.volume_ml, 1e-9);
}

TEST(Quality, AColonThatIsTooShortIsNotAdequate)
{
    Tube tube;
    auto& points = tube.skeleton.pieces[0].points;
    points.resize(900);
    const ScanQuality q = tube.measure();
    EXPECT_FALSE(q.whole.adequate);
    EXPECT_NE(q.reason, "");
}

TEST(Quality, WithoutASkeletonIsRefused)
{
    Tube tube;
    tube.skeleton = {};
    EXPECT_ANY_THROW(tube.measure());
}

class PhantomQuality : public testing::TestWithParam<double> {};

TEST_P(PhantomQuality, AgreesWithTheTruthInNoiseFluidAndCollapsedLength)
{
    NoProgress progress;
    phantom::PhantomOptions options;
    options.seed = 7;
    options.size = {160, 160, 134};
    options.folds = false;
    options.noise_hu = GetParam();
    phantom::PhantomScan scan = phantom::makeScan(options, "HFS", progress);
    const phantom::PhantomTruth& truth = scan.truth;
    Skeleton curve;
    for (const SkeletonPoint& p : truth.curve) {
        const bool bridge = p.radius_mm <= 0;
        if (curve.pieces.empty() || curve.pieces.back().bridge != bridge)
            curve.pieces.push_back({bridge, {}});
        curve.pieces.back().points.push_back(p);
    }
    const ScanQuality q = measureQuality(truth.inside, curve, truth.parts, softTissueNoise(scan.hu), {}, {}, progress);
    EXPECT_NEAR(q.noise_hu / truth.noise_hu, 1, 0.25);
    EXPECT_NEAR(q.whole.fluid_ml, truth.fluid_ml, 0.02 * truth.fluid_ml + 1);
    EXPECT_NEAR(q.whole.volume_ml, truth.volume_ml, 0.02 * truth.volume_ml);
    double gaps_mm = 0;
    for (const phantom::CollapsedGap& gap : truth.gaps)
        gaps_mm += gap.to_mm - gap.from_mm;
    EXPECT_NEAR(q.whole.collapsed_mm, gaps_mm, 12);
    EXPECT_FALSE(q.whole.adequate);
}

INSTANTIATE_TEST_SUITE_P(Noise, PhantomQuality, testing::Values(18.0, 36.0, 70.0));

}  // namespace
}  // namespace vicon::steps
