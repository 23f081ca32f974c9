#include <gtest/gtest.h>

#include "test_colon.h"
#include "vicon/viewer/model/flight_plan.h"
#include "vicon/viewer/model/flight_quality.h"

namespace vicon::viewer {
namespace {

constexpr Lens kLens{90, 512, 512};

struct Course {
    test::TestColon colon;
    PathFrames path{colon.skeleton};
    Lumen lumen{colon.inside, colon.wall_distance};
};

struct LookAheadBothWays : testing::TestWithParam<Heading> {
    Course course;
    double sign() const { return GetParam() == Heading::caecum ? 1 : -1; }
};

TEST_P(LookAheadBothWays, TheWayOnLiesInTheMiddleHalfOfNearlyEveryFrame)
{
    const auto poses = planFlight(course.path, course.lumen, 1, GetParam());
    const FlightQuality quality = qualityOf(poses, GetParam(), course.path, course.lumen, kLens);
    EXPECT_GE(quality.way_on_central, 0.95);
    EXPECT_LE(quality.wall_close, 0.05);
    EXPECT_LT(quality.turn_slow_deg_mm, 5);
}

TEST_P(LookAheadBothWays, LooksAtWhatItCanSee)
{
    const LookAhead ahead(course.path, course.lumen);
    for (double station = 20; station < course.path.length_mm() - 20; station += 7) {
        const double sight_mm = ahead.sight_mm(station, GetParam());
        ASSERT_GT(sight_mm, 0) << station;
        const double node = 2 * std::lround(station / 2);
        EXPECT_TRUE(
            course.lumen.sees(course.path.at(node).position_mm, course.path.at(node + sign() * sight_mm).position_mm))
            << station;
    }
}

TEST_P(LookAheadBothWays, TurnsWithoutJerks)
{
    const LookAhead ahead(course.path, course.lumen);
    Vector3 before;
    for (double station = 5; station < course.path.length_mm() - 5; station += 0.1) {
        const Vector3 way = ahead.direction(station, course.path.at(station).position_mm, GetParam());
        EXPECT_NEAR(length(way), 1, 1e-9);
        if (length(before) > 0) {
            EXPECT_GT(dot(way, before), std::cos(radians(1))) << station;
        }
        before = way;
    }
}

INSTANTIATE_TEST_SUITE_P(Way, LookAheadBothWays, testing::Values(Heading::caecum, Heading::rectum),
                         [](const auto& info) { return info.param == Heading::caecum ? "to_caecum" : "to_rectum"; });

TEST(FlightQuality, SaysNothingOfTurnsBetweenFramesFarApart)
{
    const Course course;
    const auto turns = [&](double step_mm) {
        const auto poses = planFlight(course.path, course.lumen, step_mm, Heading::caecum);
        return qualityOf(poses, Heading::caecum, course.path, course.lumen, kLens).turn_slow_deg_mm;
    };
    EXPECT_GT(turns(12), 0);
    EXPECT_EQ(turns(20), 0) << "also where the last two are nearer";
}

TEST(FlightQuality, TellsACameraThatLooksAtTheWall)
{
    const Course course;
    auto poses = planFlight(course.path, course.lumen, 4, Heading::caecum);
    const FlightQuality good = qualityOf(poses, Heading::caecum, course.path, course.lumen, kLens);
    for (ViewPose& view : poses)
        std::swap(view.pose.forward, view.pose.up);
    const FlightQuality bad = qualityOf(poses, Heading::caecum, course.path, course.lumen, kLens);
    EXPECT_LT(bad.way_on_central, 0.3);
    EXPECT_GT(good.way_on_central, bad.way_on_central + 0.5);
    EXPECT_GT(bad.wall_close, good.wall_close);
}

}  // namespace
}  // namespace vicon::viewer
