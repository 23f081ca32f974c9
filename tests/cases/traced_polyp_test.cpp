#include "traced_polyp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vicon {
namespace {

constexpr int kSections = 48;
constexpr std::size_t kRim = 32;  // steps down the half ball
constexpr double kRadius_mm = kRim * PolypProfile::kStep_mm * 2 / std::numbers::pi;

/// A half ball around the z axis on a wall that rises outwards.
TracedPolyp halfBall(double rise_rad)
{
    constexpr int kArc = 90;
    TracedPolyp polyp{{0, 0, kRadius_mm}, {0, 0, 1}, {}, {}};
    for (int n = 0; n < kSections; ++n) {
        const double around = 2 * std::numbers::pi * n / kSections;
        const Vector3 out{std::cos(around), std::sin(around), 0};
        std::vector<Point3> line;
        for (int a = 0; a <= kArc; ++a) {
            const double down = std::numbers::pi / 2 * a / kArc;
            line.push_back(Point3{} + out * (kRadius_mm * std::sin(down)) + Vector3{0, 0, kRadius_mm * std::cos(down)});
        }
        const double wall_mm = 10;
        line.push_back(line.back() + out * (wall_mm * std::cos(rise_rad)) +
                       Vector3{0, 0, wall_mm * std::sin(rise_rad)});
        polyp.profiles.push_back(polypProfileOf(line, polyp.top, polyp.axis, out));
        polyp.rims.push_back(kRim);
    }
    return polyp;
}

TEST(TracedPolyp, OfAHalfBallHasItsDiameterAndVolume)
{
    const TracedPolyp polyp = halfBall(0);
    const HeadChord chord = largestChordOf(polyp);
    EXPECT_NEAR(chord.length_mm, 2 * kRadius_mm, 0.1);
    EXPECT_TRUE(chord.onWall());
    EXPECT_NEAR(seenVolume_mm3(polyp, {}), 2.0 / 3 * std::numbers::pi * std::pow(kRadius_mm, 3), 2);
    EXPECT_NEAR(roughness_mm(polyp.rimPoints()), 0, 0.01);
}

TEST(TracedPolyp, ACutIsTheSectionOfThePlane)
{
    const TracedPolyp polyp = halfBall(0);
    constexpr double kOff_mm = 3;
    const double half_mm = std::sqrt(kRadius_mm * kRadius_mm - kOff_mm * kOff_mm);
    const HeadCut aside = cutOf(polyp, {1, 0, 0}, kOff_mm);
    EXPECT_NEAR(aside.largest().length_mm, 2 * half_mm, 0.1);
    EXPECT_TRUE(aside.largest().onWall());
    EXPECT_NEAR(aside.area_mm2({kOff_mm, 0, 0}, {0, 1, 0}, {0, 0, 1}), std::numbers::pi * half_mm * half_mm / 2, 0.5);
    const HeadCut level = cutOf(polyp, {0, 0, 1}, kOff_mm - kRadius_mm);
    EXPECT_NEAR(level.largest().length_mm, 2 * half_mm, 0.05);
    EXPECT_FALSE(level.largest().onWall());
    EXPECT_NEAR(level.area_mm2({0, 0, kOff_mm}, {1, 0, 0}, {0, 1, 0}), std::numbers::pi * half_mm * half_mm, 0.5);
    EXPECT_TRUE(cutOf(polyp, {1, 0, 0}, kRadius_mm + 1).points.empty());
}

TEST(TracedPolyp, TheWallsRiseIsItsAngleAndFoldsBesideDoNotCount)
{
    for (const double rise_rad : {-0.2, 0.0, 0.3})
        EXPECT_NEAR(wallRise_rad(halfBall(rise_rad)), rise_rad, 0.02);
    TracedPolyp by_fold = halfBall(0);
    const TracedPolyp steep = halfBall(1.2);
    for (std::size_t n = 0; n < kSections / 5; ++n)
        by_fold.profiles[n] = steep.profiles[n];
    EXPECT_NEAR(wallRise_rad(by_fold), 0, 0.02);
    EXPECT_LE(wallRise_rad(steep), 0.8) << "no wall is so steep all around";
}

TEST(TracedPolyp, ARimRunsSteeplyWhereTheWallIsASaddle)
{
    EXPECT_NEAR(rimSlope2(halfBall(0), largestChordOf(halfBall(0))), 0, 1e-6);
    constexpr double kRise_mm = 1;  // the rim's height is this times the cosine of twice the way around
    TracedPolyp saddle = halfBall(0);
    for (int n = 0; n < kSections; ++n)
        saddle.profiles[std::size_t(n)].points[kRim] +=
            saddle.axis * (kRise_mm * std::cos(4 * std::numbers::pi * n / kSections));
    const auto chordAt = [&](int n) {
        const Point3 from = saddle.profiles[std::size_t(n)].points[kRim],
                     to = saddle.profiles[std::size_t(n + kSections / 2)].points[kRim];
        return HeadChord{distance(from, to), from, to, 2};
    };
    EXPECT_NEAR(rimSlope2(saddle, chordAt(0)), 0, 1e-6) << "along the valley";
    EXPECT_NEAR(rimSlope2(saddle, chordAt(kSections / 4)), 0, 1e-6) << "along the ridge";
    const double slope = 2 * kRise_mm / kRadius_mm;  // between both
    EXPECT_NEAR(rimSlope2(saddle, chordAt(kSections / 8)), slope * slope, 0.1 * slope * slope);
}

}  // namespace
}  // namespace vicon
