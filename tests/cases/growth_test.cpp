// What is said of a finding's growth, and when nothing is.
#include "vicon/cases/growth.h"

#include <gmock/gmock.h>

#include <cmath>

namespace vicon {
namespace {

using testing::HasSubstr;

/// Outlined, from thin slices of a soft kernel.
MeasuredSize outlined(double size_mm, double half_mm, double volume_ml, const std::string& date)
{
    return {.size_mm = size_mm,
            .from = "surface",
            .least_mm = size_mm - half_mm,
            .most_mm = size_mm + half_mm,
            .volume_ml = volume_ml,
            .kernel = "B30f",
            .slice_thickness_mm = 1,
            .date = date};
}

/// Of a sphere.
double volumeOf_ml(double diameter_mm)
{
    return 3.14159265358979 / 6 * diameter_mm * diameter_mm * diameter_mm / 1000;
}

const MeasuredSize kThen = outlined(8, 0.4, volumeOf_ml(8), "20240101");

TEST(Growth, IsTheDifferenceWithItsIntervalAndItsRate)
{
    const Growth g = growthBetween(kThen, outlined(10, 0.3, volumeOf_ml(10), "20260101"));
    EXPECT_EQ(g.why_not, "");
    EXPECT_NEAR(*g.years, 2.001, 0.001);
    EXPECT_NEAR(g.diameter_mm->about, 2, 1e-9);
    EXPECT_NEAR(g.diameter_mm->least, 1.5, 1e-9) << "half widths of 0.4 and 0.3 mm add to 0.5";
    EXPECT_NEAR(g.diameter_mm->most, 2.5, 1e-9);
    EXPECT_NEAR(g.volume_percent->about, 95.3, 0.05);
    EXPECT_NEAR(g.percent_a_year->about, 95.3 / 2.001, 0.05);
    EXPECT_EQ(g.verdict, GrowthVerdict::grew);
    EXPECT_THAT(growthWords(g), HasSubstr("+2.0 mm (+1.5 to +2.5), volume +95 %"));
    EXPECT_THAT(growthWords(g), HasSubstr("in 2.0 years: grew"));
}

TEST(Growth, OfAVolumeHasTheIntervalThatItWasMeasuredWith)
{
    MeasuredSize then = kThen, now = outlined(10, 0.1, volumeOf_ml(10), "20260101");
    const double ratio = volumeOf_ml(10) / volumeOf_ml(8);
    for (MeasuredSize* size : {&then, &now}) {
        size->volume_least_ml = 0.7 * *size->volume_ml;
        size->volume_most_ml = 1.3 * *size->volume_ml;
    }
    const Growth g = growthBetween(then, now);
    EXPECT_NEAR(g.volume_percent->most - g.volume_percent->about, 100 * ratio * std::sqrt(2.0) * 0.3, 1e-6);
}

TEST(Growth, HasAVerdictByTwentyPercentAYearAndItsInterval)
{
    const struct {
        double factor;  ///< of the volume, in a year
        double half_mm;
        GrowthVerdict verdict;
    } cases[] = {{1.8, 0.2, GrowthVerdict::grew},    {1.19, 0.2, GrowthVerdict::stable},
                 {0.81, 0.2, GrowthVerdict::stable}, {0.5, 0.1, GrowthVerdict::shrank},
                 {1.0, 0.2, GrowthVerdict::stable},  {1.3, 1.0, GrowthVerdict::not_sure}};
    for (const auto& c : cases) {
        const MeasuredSize now = outlined(8 * std::cbrt(c.factor), c.half_mm, volumeOf_ml(8) * c.factor, "20241231");
        MeasuredSize then = kThen;
        then.least_mm = 8 - c.half_mm;
        then.most_mm = 8 + c.half_mm;
        EXPECT_EQ(growthBetween(then, now).verdict, c.verdict)
            << c.factor << " " << growthWords(growthBetween(then, now));
    }
}

TEST(Growth, OfAHandMeasuredSizeHasThePublishedSpread)
{
    MeasuredSize then = kThen, now = outlined(10, 0.3, volumeOf_ml(10), "20260101");
    for (MeasuredSize* size : {&then, &now}) {
        size->from = "best plane";
        size->least_mm.reset();
        size->most_mm.reset();
        size->volume_ml.reset();
    }
    const Growth g = growthBetween(then, now);
    EXPECT_NEAR(g.diameter_mm->most - g.diameter_mm->about, std::sqrt(2.0) * 1.2816 * 1.76, 1e-3);
    EXPECT_FALSE(g.volume_percent);
    EXPECT_FALSE(g.verdict);
}

TEST(Growth, IsNotToldWhereTheScansDoNotAllowIt)
{
    EXPECT_EQ(growthBetween(outlined(10, 0.3, volumeOf_ml(10), "20260101"), kThen).why_not,
              "the earlier report is dated after this examination");
    const auto change = [](void (*how)(MeasuredSize&)) {
        MeasuredSize size = outlined(10, 0.3, 0.5, "20260101");
        how(size);
        return growthBetween(kThen, size);
    };
    const struct {
        void (*how)(MeasuredSize&);
        const char* why;
    } cases[] = {
        {[](MeasuredSize& s) { s.kernel = "B70f"; }, "the kernels differ (then: B30f, now: B70f)"},
        {[](MeasuredSize& s) { s.kernel.clear(); }, "the kernel now is not known"},
        {[](MeasuredSize& s) { s.slice_thickness_mm = 0; }, "the slice thickness now is not known"},
        {[](MeasuredSize& s) { s.slice_thickness_mm = 3; }, "slices of 3.0 mm are too thick"},
        {[](MeasuredSize& s) { s.slice_thickness_mm = 1.5; }, "the slices differ (then: 1.0 mm, now: 1.5 mm)"},
        {[](MeasuredSize& s) { s.from = "reader"; }, "taken in different ways (then: surface, now: reader)"},
        {[](MeasuredSize& s) { s.least_mm.reset(), s.most_mm.reset(); }, "one size was outlined"},
        {[](MeasuredSize& s) { s.size_mm.reset(); }, "no size was measured now"},
    };
    for (const auto& c : cases) {
        const Growth g = change(c.how);
        EXPECT_THAT(g.why_not, HasSubstr(c.why));
        EXPECT_FALSE(g.diameter_mm || g.volume_percent || g.percent_a_year);
        EXPECT_FALSE(g.verdict);
        EXPECT_THAT(growthWords(g), HasSubstr("growth is not told: "));
    }
}

TEST(Growth, HasNoRateOverLessThanThreeMonthsOrWithoutDates)
{
    for (const char* date : {"20240215", "", "2024-02-30", "20240230", "202601011", "202601x1", "2026010"}) {
        const Growth g = growthBetween(kThen, outlined(10, 0.3, volumeOf_ml(10), date));
        EXPECT_TRUE(g.diameter_mm && g.volume_percent) << date;
        EXPECT_FALSE(g.percent_a_year) << date;
        EXPECT_FALSE(g.verdict) << date;
    }
}

TEST(Growth, IsReadBackAsItWasWritten)
{
    for (const std::string kernel : {"B30f", "B70f"}) {
        MeasuredSize now = outlined(10, 0.3, volumeOf_ml(10), "20260101");
        now.kernel = kernel;
        now.volume_least_ml = 0.4;
        now.volume_most_ml = 0.6;
        const Growth g = growthBetween(kThen, now);
        EXPECT_EQ(toJson(growthFromJson(toJson(g))), toJson(g));
        const MeasuredSize back = measuredSizeFromJson(toJson(now));
        EXPECT_EQ(toJson(back), toJson(now));
        EXPECT_EQ(back.size_mm, now.size_mm);
        EXPECT_EQ(back.least_mm, now.least_mm);
        EXPECT_EQ(back.most_mm, now.most_mm);
        EXPECT_EQ(back.volume_ml, now.volume_ml);
        EXPECT_EQ(back.volume_most_ml, now.volume_most_ml);
    }
}

}  // namespace
}  // namespace vicon
