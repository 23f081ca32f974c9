#include "vicon/viewer/model/correspondence.h"

#include <gtest/gtest.h>

namespace vicon::viewer {
namespace {

/// A colon whose parts end at these stations, from the rectum.
ColonScale scale(const std::vector<double>& ends_mm)
{
    ColonScale made{ends_mm.back(), {}};
    double from = 0;
    for (std::size_t n = 0; n < ends_mm.size(); ++n) {
        made.parts.push_back({ColonPart(n), from, ends_mm[n]});
        from = ends_mm[n];
    }
    return made;
}

const ColonScale kSupine = scale({100, 500, 700, 750, 1200, 1250, 1400, 1500});
const ColonScale kProne = scale({80, 680, 800, 840, 1100, 1160, 1500, 1560});

TEST(Correspondence, IsTheSameFractionOfTheSamePart)
{
    for (std::size_t n = 0; n < kSupine.parts.size(); ++n)
        for (const double t : {0.0, 0.25, 0.9}) {
            const auto& a = kSupine.parts[n];
            const auto& b = kProne.parts[n];
            EXPECT_NEAR(correspondingStation_mm(kSupine, a.from_mm + t * (a.to_mm - a.from_mm), kProne),
                        b.from_mm + t * (b.to_mm - b.from_mm), 1e-9)
                << nameOf(a.part) << " at " << t;
        }
    EXPECT_NEAR(correspondingStation_mm(kSupine, 1500, kProne), 1560, 1e-9);
}

TEST(Correspondence, ThereAndBackIsTheSamePlaceAndNeverRunsBack)
{
    double before = -1;
    for (double s = 0; s <= 1500; s += 7) {
        const double there = correspondingStation_mm(kSupine, s, kProne);
        EXPECT_GT(there, before);
        EXPECT_NEAR(correspondingStation_mm(kProne, there, kSupine), s, 1e-9);
        before = there;
    }
}

TEST(Correspondence, WithoutPartsItIsTheFractionOfTheWholeWay)
{
    const ColonScale plain{2000, {}};
    EXPECT_NEAR(correspondingStation_mm(kSupine, 750, plain), 1000, 1e-9);
    EXPECT_NEAR(correspondingStation_mm(plain, 500, kSupine), 375, 1e-9);
    EXPECT_NEAR(correspondingStation_mm(plain, 9999, kSupine), 1500, 1e-9) << "beyond the end: the end";
    EXPECT_EQ(correspondingStation_mm(ColonScale{}, 5, kSupine), 0);
}

TEST(Correspondence, APartThatOneScanLacksIsPassedOver)
{
    const ColonScale lacking = scale({80, 680, 800, 800, 1100, 1160, 1500, 1560});  // no splenic flexure
    double before = -1;
    for (double s = 0; s <= 1500; s += 7) {
        const double there = correspondingStation_mm(kSupine, s, lacking);
        EXPECT_GE(there, before) << s;
        before = there;
    }
    EXPECT_NEAR(correspondingStation_mm(kSupine, 750, lacking), 800, 1e-9);
    EXPECT_NEAR(correspondingStation_mm(kSupine, 300, lacking), 380, 1e-9);
}

}  // namespace
}  // namespace vicon::viewer
