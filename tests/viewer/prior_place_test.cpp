#include "vicon/viewer/model/prior_place.h"

#include <gtest/gtest.h>

namespace vicon::viewer {
namespace {

constexpr double kNear_mm = 5, kRing_px = 10, kText_px = 12;

PlaneView axialView()
{
    return {
        .centre_mm = {0, 0, 0}, .right = {1, 0, 0}, .down = {0, 1, 0}, .mm_per_pixel = 1, .width = 300, .height = 200};
}

Overlay diamondOf(const PriorPlace& place, double depth_mm = 0)
{
    Overlay overlay;
    addPriorDiamond(overlay, axialView(), place, depth_mm, kNear_mm, kRing_px, kText_px);
    return overlay;
}

TEST(PriorDiamond, ItsLabelStandsTowardsTheMiddle)
{
    for (const double x : {-140.0, -20.0, 20.0, 140.0}) {
        const Overlay overlay = diamondOf({.label = "same place", .position_mm = {x, 90, 0}});
        ASSERT_EQ(overlay.texts.size(), 1U) << x;
        const OverlayText& label = overlay.texts.front();
        const double diamond_px = axialView().toPixel({x, 90, 0}).x;
        EXPECT_EQ(label.across, x > 0 ? Across::right : Across::left) << x;
        EXPECT_EQ(label.at.x<diamond_px, x> 0) << x;
    }
}

TEST(PriorDiamond, IsSolidAtTheMiddleDashedBesideItAndNotThereFarFromIt)
{
    PriorPlace place{.label = "2021: polyp", .position_mm = {0, 0, 0}};
    for (double z = -30; z <= 30; z += 2)
        place.band_mm.push_back({z / 2, 0, z});
    const Overlay middle = diamondOf(place), beside = diamondOf(place, 20), far = diamondOf(place, 50);
    ASSERT_EQ(middle.lines.size(), 1U);
    ASSERT_EQ(beside.lines.size(), 1U);
    EXPECT_EQ(middle.lines.front().dash_px, 0);
    EXPECT_GT(beside.lines.front().dash_px, 0);
    EXPECT_NEAR(beside.lines.front().points.front().x, axialView().toPixel({8, 0, 16}).x, 0.01)
        << "of what is within 5 mm, the nearest to the middle";
    EXPECT_TRUE(far.lines.empty() && far.texts.empty());
}

}  // namespace
}  // namespace vicon::viewer
