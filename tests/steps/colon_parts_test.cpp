#include "vicon/steps/colon_parts.h"

#include <gtest/gtest.h>

#include "vicon/phantom/phantom.h"
#include "vicon/steps/resample.h"
#include "vicon/steps/segment.h"
#include "vicon/steps/skeleton.h"

namespace vicon::steps {
namespace {

struct Study {
    std::uint64_t seed;
    const char* position;
};

phantom::PhantomOptions smallPhantom(std::uint64_t seed)
{
    phantom::PhantomOptions options;
    options.seed = seed;
    options.size = {128, 128, 108};
    options.folds = false;
    options.gaps = 0;
    return options;
}

Skeleton curveOf(const phantom::PhantomTruth& truth)
{
    return {{{false, truth.curve}}};
}

/// Worst distance along the curve between a boundary and the true one.
double worstBoundary_mm(const ColonPartRanges& found, const ColonPartRanges& truth)
{
    if (found.size() != truth.size())
        return 1e9;
    double worst = 0;
    for (std::size_t n = 1; n < truth.size(); ++n)
        worst = std::max(worst, std::abs(found[n].from_mm - truth[n].from_mm));
    return worst;
}

// The constants of findColonParts() were chosen on seeds 1 to 12, supine.
class TrueCurves : public testing::TestWithParam<Study> {};

TEST_P(TrueCurves, PartsBeginWithin45MmOfWhereTheyAreFixedInTheBody)
{
    NoProgress progress;
    const auto truth = phantom::makeScan(smallPhantom(GetParam().seed), GetParam().position, progress).truth;
    const FoundParts found = findColonParts(curveOf(truth));
    EXPECT_EQ(found.reason, "");
    std::string offsets;
    for (std::size_t n = 1; n < truth.parts.size() && n < found.ranges.size(); ++n)
        offsets += std::to_string(std::lround(found.ranges[n].from_mm - truth.parts[n].from_mm)) + " ";
    RecordProperty("offsets_mm", offsets);
    EXPECT_LT(worstBoundary_mm(found.ranges, truth.parts), 45) << offsets;
}

INSTANTIATE_TEST_SUITE_P(UnseenSeeds, TrueCurves,
                         testing::Values(Study{101, "HFS"}, Study{102, "HFP"}, Study{103, "FFS"}, Study{104, "FFP"},
                                         Study{105, "HFDL"}, Study{106, "FFDR"}, Study{107, "HFS"}, Study{108, "HFP"}),
                         [](const auto& it) { return std::to_string(it.param.seed) + it.param.position; });

TEST(ColonParts, AreFoundOnTheSkeletonOfAScanAsOnTheTrueCurve)
{
    NoProgress progress;
    phantom::PhantomOptions options = smallPhantom(3);
    options.size = {160, 160, 134};
    phantom::PhantomScan scan = phantom::makeScan(options, "HFP", progress);
    const HuVolume volume = resample(std::move(scan.hu), {}, progress);
    const Segmentation segmented = segmentColon(volume, scan.truth.gravity, {}, progress);
    const Skeleton curve = findSkeleton(segmented.inside, segmented.plan, {}, progress).curve;
    const ColonPartRanges found = findColonParts(curve).ranges, expected = findColonParts(curveOf(scan.truth)).ranges;
    ASSERT_EQ(found.size(), 8U);
    // In space, since the skeleton of such coarse voxels is 1 to 2 % short.
    for (std::size_t n = 1; n < found.size(); ++n)
        EXPECT_LT(
            distance(curve.at(found[n].from_mm).position_mm, curveOf(scan.truth).at(expected[n].from_mm).position_mm),
            20)
            << nameOf(found[n].part);
}

TEST(ColonParts, CoverTheWholeSkeletonInOrder)
{
    NoProgress progress;
    const Skeleton curve = curveOf(phantom::makeScan(smallPhantom(2), "HFS", progress).truth);
    const ColonPartRanges parts = findColonParts(curve).ranges;
    ASSERT_EQ(parts.size(), 8U);
    EXPECT_EQ(parts.front().from_mm, 0);
    EXPECT_EQ(parts.back().to_mm, curve.length_mm());
    for (std::size_t n = 0; n < parts.size(); ++n) {
        EXPECT_EQ(int(parts[n].part), int(n));
        EXPECT_LT(parts[n].from_mm, parts[n].to_mm);
        if (n > 0) {
            EXPECT_EQ(parts[n].from_mm, parts[n - 1].to_mm);
        }
    }
}

/// A change of the true curve after which no name must be given.
struct Spoilt {
    const char* name;
    void (*spoil)(std::vector<SkeletonPoint>&);
};

class NoNames : public testing::TestWithParam<Spoilt> {};

TEST_P(NoNames, AreGivenWhereTheShapeIsNotThatOfAColon)
{
    NoProgress progress;
    auto curve = phantom::makeScan(smallPhantom(2), "HFS", progress).truth.curve;
    GetParam().spoil(curve);
    const FoundParts found = findColonParts({{{false, curve}}});
    EXPECT_TRUE(found.ranges.empty());
    EXPECT_NE(found.reason, "");
}

void mirror(std::vector<SkeletonPoint>& curve)
{
    for (SkeletonPoint& p : curve)
        p.position_mm.x = -p.position_mm.x;
}

void turnRound(std::vector<SkeletonPoint>& curve)
{
    const double length_mm = curve.back().station_mm;
    std::reverse(curve.begin(), curve.end());
    for (SkeletonPoint& p : curve)
        p.station_mm = length_mm - p.station_mm;
}

void keepLeftHalf(std::vector<SkeletonPoint>& curve)
{
    std::erase_if(curve, [](const SkeletonPoint& p) { return p.station_mm > 680; });
}

INSTANTIATE_TEST_SUITE_P(Curves, NoNames,
                         testing::Values(Spoilt{"Mirrored", mirror}, Spoilt{"FromCaecumToRectum", turnRound},
                                         Spoilt{"WithoutTheRightColon", keepLeftHalf}),
                         [](const auto& it) { return std::string(it.param.name); });

TEST(ColonParts, OfAnEmptySkeletonAreNotKnown)
{
    EXPECT_TRUE(findColonParts({}).ranges.empty());
}

}  // namespace
}  // namespace vicon::steps
