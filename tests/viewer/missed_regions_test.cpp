#include "vicon/viewer/model/missed_regions.h"

#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "vicon/viewer/model/review_rule.h"
#include "vicon/viewer/model/scan_coverage.h"

namespace vicon::viewer {
namespace {

UnseenPatch patch(double station_mm, std::vector<std::uint32_t> triangles)
{
    UnseenPatch made;
    made.station_mm = station_mm;
    made.triangles = std::move(triangles);
    made.area_mm2 = 100.0 * double(made.triangles.size());
    return made;
}

/// Ten triangles of 100 mm2.
Coverage coverage(const std::vector<std::uint32_t>& seen)
{
    Coverage made(std::vector<float>(10, 100.F));
    made.see(seen);
    return made;
}

TEST(MissedRegions, AreGoneThroughFromTheRectumAndTickedOffWhenFourFifthsAreReviewed)
{
    MissedRegions missed({patch(300, {5, 6, 7, 8, 9}), patch(80, {0, 1, 2, 3, 4})});
    EXPECT_EQ(missed.regions()[0].station_mm, 80);
    EXPECT_EQ(missed.next(), std::optional<std::size_t>(0));
    missed.visit(0);
    EXPECT_FALSE(missed.tick(coverage({0, 1, 2}))) << "three fifths";
    EXPECT_TRUE(missed.tick(coverage({0, 1, 2, 3})));
    EXPECT_FALSE(missed.tick(coverage({0, 1, 2, 3}))) << "once";
    EXPECT_TRUE(missed.done(0));
    EXPECT_EQ(missed.next(), std::optional<std::size_t>(1));
    missed.visit(1);
    EXPECT_EQ(missed.next(), std::optional<std::size_t>(1)) << "left undone, it comes again";
    missed.tick(coverage({5, 6, 7, 8, 9}));
    EXPECT_EQ(missed.countDone(), 2U);
    EXPECT_FALSE(missed.next());
    EXPECT_FALSE(MissedRegions().next());
    EXPECT_EQ(missed.trianglesOf(0, 10), (std::vector<std::uint8_t>{1, 1, 1, 1, 1, 0, 0, 0, 0, 0}));
}

TEST(MissedRegions, ThatWereLookedAtStayCountedWhenTheyAreListedAnewAndNoneTwice)
{
    MissedRegions missed({patch(10, {0, 1}), patch(20, {2, 3}), patch(30, {4, 5, 6}), patch(40, {7})});
    const auto counted = [&] { return std::pair(missed.countLookedAt(), missed.countListed()); };
    EXPECT_EQ(counted(), std::pair(std::size_t(0), std::size_t(4)));
    for (const std::size_t region : {0, 2, 2})
        missed.visit(region);
    EXPECT_EQ(counted(), std::pair(std::size_t(2), std::size_t(4)));
    // The first one is reviewed by now, and so is the one that was never visited; of the third one some is left.
    missed = missed.listedAnew({patch(30, {5}), patch(40, {7})});
    EXPECT_FALSE(missed.visited());
    EXPECT_EQ(counted(), std::pair(std::size_t(2), std::size_t(3))) << "the first, the third's rest, the last";
    missed.visit(0);
    EXPECT_EQ(counted(), std::pair(std::size_t(2), std::size_t(3))) << "looked at before";
    missed.visit(1);
    EXPECT_EQ(counted(), std::pair(std::size_t(3), std::size_t(3)));
    missed = missed.listedAnew({});
    EXPECT_EQ(counted(), std::pair(std::size_t(3), std::size_t(3)));
    missed = missed.listedAnew({patch(10, {1})});
    EXPECT_EQ(counted(), std::pair(std::size_t(3), std::size_t(3))) << "smaller ones are listed now";
}

/// A triangle of 1 mm before the eye, turned away from it about the vertical.
std::vector<float> triangleAt(double distance_mm, double turned_deg)
{
    const double c = std::cos(radians(turned_deg)), s = std::sin(radians(turned_deg));
    const auto corner = [&](double across, double up) {
        return std::array<float, 3>{float(across * c), float(distance_mm + across * s), float(up)};
    };
    std::vector<float> points;
    for (const auto& p : {corner(-0.5, -0.3), corner(0.5, -0.3), corner(0, 0.6)})
        points.insert(points.end(), p.begin(), p.end());
    return points;
}

TEST(ReviewRule, WallCountsUnderLessThan60DegreesAndWithThreePixelsAMillimetre)
{
    const Pose pose{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const Lens lens{90, 600, 600};  // 300 pixels away: 3 a millimetre at 100 mm
    const auto counts = [&](double distance_mm, double turned_deg, double ratio = 1) {
        return !wellShown(triangleAt(distance_mm, turned_deg), {0, 1, 2}, {0}, pose, lens, ratio).empty();
    };
    for (const double turned : {0.0, 30.0, -58.0, 58.0})
        EXPECT_TRUE(counts(50, turned)) << turned;
    for (const double turned : {-62.0, 62.0, 89.0})
        EXPECT_FALSE(counts(50, turned)) << turned;
    EXPECT_TRUE(counts(98, 0));
    EXPECT_FALSE(counts(102, 0));
    EXPECT_FALSE(counts(98, 0, 2)) << "of a screen with twice as many pixels";
}

TEST(ReviewRule, WallCountsOnceItWasOnTheScreenForATenthOfASecondWithoutABreak)
{
    const double least_s = kLeastShown_s;
    ScanCoverage seen(std::vector<float>(10, 1.F));
    seen.show({1, 2, 3}, 5.0, least_s);
    EXPECT_EQ(seen.fraction(), 0);
    seen.show({3, 2, 4}, 5.06, least_s);
    EXPECT_EQ(seen.fraction(), 0);
    seen.show({2, 5}, 5.11, least_s);
    EXPECT_NEAR(seen.fraction(), 0.1, 1e-9) << "2 alone: 3 was gone by then, 1 earlier";
    seen.show({3}, 5.15, least_s);
    seen.show({3}, 5.20, least_s);
    EXPECT_NEAR(seen.fraction(), 0.1, 1e-9) << "before and after a break do not add up";
    seen.stillShown(5.26, least_s);
    EXPECT_NEAR(seen.fraction(), 0.2, 1e-9) << "it stayed";
    seen.forget();
    seen.stillShown(9, least_s);
    EXPECT_EQ(seen.fraction(), 0);
}

}  // namespace
}  // namespace vicon::viewer
