// The terminal ileum: a narrow passage in the side of the colon leads to it, and it does not belong to the lumen.
#include <gtest/gtest.h>

#include <cmath>

#include "segment_shapes.h"
#include "vicon/steps/segment.h"

namespace vicon::steps {
namespace {

using test::blurred;
using test::centredGrid;
using test::tubeDistance;

/// A tube of even radius.
struct Tube {
    std::vector<Point3> line;
    double radius_mm = 0;
    bool colon = true;
};

double distanceTo(const std::vector<Tube>& tubes, Point3 p, bool colon_only)
{
    double least = 1e300;
    for (const Tube& tube : tubes)
        if (tube.colon || !colon_only)
            least = std::min(least, tubeDistance(tube.line, tube.radius_mm, p));
    return least;
}

const Grid kGrid = centredGrid({150, 90, 130}, 1.2);

/// A small colon: up on the left, across, down on the right.
Tube colon()
{
    return {{{0, 15, -62}, {0, 15, -40}, {50, 0, -36}, {50, 0, 42}, {-50, 0, 42}, {-50, 0, -46}}, 16};
}

HuVolume drawn(const std::vector<Tube>& tubes)
{
    HuVolume volume(kGrid, kPaddingHu);
    for (std::size_t n = 0; n < volume.voxels.size(); ++n) {
        const Point3 p = kGrid.pointAt(kGrid.indexOf(n));
        const double body_mm = (1 - std::hypot(p.x / 82, p.y / 46)) * 46;
        const double hu = -1000 + 1040 * blurred(body_mm, 0.7);
        const double d = distanceTo(tubes, p, false);
        volume.voxels[n] = std::int16_t(std::lround(d < 5 ? -1000 + (hu + 1000) * blurred(d, 0.7) : hu));
    }
    return volume;
}

Segmentation segmented(const std::vector<Tube>& tubes)
{
    NoProgress progress;
    return segmentColon(drawn(tubes), {0, 1, 0}, {}, progress);
}

/// Found voxels farther than `margin_mm` outside the colon, and colon's voxels as far inside that were not found, in
/// ml.
struct Errors {
    double outside_ml = 0, missed_ml = 0;
};

Errors errorsOf(const InsideVolume& found, const std::vector<Tube>& tubes)
{
    constexpr double kMargin_mm = 1.2;
    Errors errors;
    const double voxel_ml = kGrid.voxelVolume_mm3() / 1000;
    for (std::size_t n = 0; n < kGrid.voxelCount(); ++n) {
        const Point3 p = kGrid.pointAt(kGrid.indexOf(n));
        const double d = distanceTo(tubes, p, true);
        const bool inside = found.valueOr(found.grid.indexAt(p), kOutside) != kOutside;
        errors.outside_ml += inside && d > kMargin_mm ? voxel_ml : 0;
        errors.missed_ml += !inside && d < -kMargin_mm ? voxel_ml : 0;
    }
    return errors;
}

/// What leaves the ascending colon to the middle, 40 mm above its end: a valve, and the ileum behind it.
std::vector<Tube> withIleum(double valve_mm, double ileum_mm)
{
    return {colon(),
            {{{-38, 0, -10}, {-26, 0, -10}}, valve_mm, false},
            {{{-26 + ileum_mm, 0, -10}, {0, 5, 0}, {10, -10, 12}, {-10, -12, 20}}, ileum_mm, false}};
}

class Valves : public testing::TestWithParam<double> {};

TEST_P(Valves, TheLumenBehindThemIsCutOff)
{
    const std::vector<Tube> tubes = withIleum(GetParam(), 6.5);
    const Segmentation result = segmented(tubes);
    const Errors errors = errorsOf(result.inside, tubes);
    EXPECT_LT(errors.outside_ml, 0.15) << result.reason;
    EXPECT_EQ(errors.missed_ml, 0);
    ASSERT_EQ(result.measures["ileum"].size(), 1U);
    const auto& valve = result.measures["ileum"][0]["valve_mm"];
    EXPECT_LT(distance({valve[0], valve[1], valve[2]}, {-34, 0, -10}), 6);
    EXPECT_NE(result.reason.find("terminal ileum"), std::string::npos) << result.reason;
    ASSERT_EQ(result.plan.pieces.size(), 1U);
    EXPECT_LT(distance(result.plan.pieces[0].caecal_end_mm, colon().line.back()), 18);
}

INSTANTIATE_TEST_SUITE_P(Radii, Valves, testing::Values(1.6, 2.0, 2.5));

struct Kept {
    const char* what;
    std::vector<Tube> tubes;
};

class NoValve : public testing::TestWithParam<Kept> {};

TEST_P(NoValve, NothingOfTheColonIsCutOff)
{
    const Segmentation result = segmented(GetParam().tubes);
    const Errors errors = errorsOf(result.inside, GetParam().tubes);
    EXPECT_EQ(errors.missed_ml, 0) << result.reason;
    EXPECT_LT(errors.outside_ml, 0.15) << result.reason;
    EXPECT_TRUE(result.measures["ileum"].empty());
}

Tube shortColon()
{
    Tube tube = colon();
    tube.line.back() = {-50, 0, 0};
    return tube;
}

/// A fold across the colon before a caecum that is narrow itself.
std::vector<Tube> narrowEnd()
{
    return {shortColon(), {{{-50, 0, -10}, {-50, 0, -24}}, 2.2}, {{{-50, 0, -31}, {-50, 0, -54}}, 7}};
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, NoValve,
    testing::Values(Kept{"nothing", {colon()}}, Kept{"fold", narrowEnd()},
                    // A fold before a wide caecum.
                    Kept{"wide",
                         {shortColon(), {{{-50, 0, -10}, {-50, 0, -24}}, 2.2}, {{{-50, 0, -36}, {-50, 0, -44}}, 13}}},
                    // A pouch beside the colon, such as a diverticulum.
                    Kept{"pouch", {colon(), {{{-38, 0, -10}, {-26, 0, -10}}, 2}, {{{-22, 0, -10}, {-20, 0, -10}}, 4}}}),
    [](const auto& info) { return info.param.what; });

TEST(Ileum, WhatMayBeItIsKeptAndSaid)
{
    const Segmentation result = segmented(narrowEnd());
    EXPECT_NE(result.reason.find("may be terminal ileum and was kept"), std::string::npos) << result.reason;
}

TEST(Ileum, WithAnAddedPointInItIsKept)
{
    std::vector<Tube> tubes = withIleum(2, 6.5);
    NoProgress progress;
    const Segmentation result = segmentColon(drawn(tubes), {0, 1, 0}, {.add = {{0, 5, 0}}}, progress);
    EXPECT_TRUE(result.measures["ileum"].empty());
    tubes[1].colon = tubes[2].colon = true;
    EXPECT_EQ(errorsOf(result.inside, tubes).missed_ml, 0);
}

TEST(Ileum, OnTheLeftIsKept)
{
    std::vector<Tube> tubes = withIleum(2, 6.5);
    for (Tube& tube : tubes)
        for (Point3& p : tube.line)
            p.x = -p.x;
    const Segmentation result = segmented(tubes);
    EXPECT_TRUE(result.measures["ileum"].empty());
    for (Tube& tube : tubes)
        tube.colon = true;
    EXPECT_EQ(errorsOf(result.inside, tubes).missed_ml, 0);
}

}  // namespace
}  // namespace vicon::steps
