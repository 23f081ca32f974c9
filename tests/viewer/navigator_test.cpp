#include "vicon/viewer/model/navigator.h"

#include <gtest/gtest.h>

#include "test_colon.h"

namespace vicon::viewer {
namespace {

struct Navigation : testing::Test {
    test::TestColon colon;
    PathFrames path{colon.skeleton};
    Lumen lumen{colon.inside, colon.wall_distance};
    Navigator navigator{path, lumen, colon.exit_distance};

    void pass(double seconds, double rate_hz)
    {
        for (int n = 0; n < int(std::lround(seconds * rate_hz)); ++n)
            navigator.advance(1 / rate_hz);
    }
};

TEST_F(Navigation, PlannedFlightGoesAtItsSpeedWhateverTheFrameRate)
{
    std::vector<double> there, back;
    for (const double rate : {30.0, 144.0}) {
        navigator.jumpTo(20);
        navigator.setSpeed(25);
        navigator.fly(1);
        pass(2, rate);
        there.push_back(navigator.state().station_mm);
        EXPECT_LE(there.back(), 70 + 1e-6) << rate;
        EXPECT_GT(there.back(), 45) << rate;
        navigator.fly(-1);
        pass(1, rate);
        back.push_back(navigator.state().station_mm);
        EXPECT_GE(back.back(), there.back() - 25 - 1e-6) << rate;
        navigator.fly(0);
        pass(1, rate);
        EXPECT_NEAR(navigator.state().station_mm, back.back(), 1e-6) << rate;
    }
    EXPECT_NEAR(there[0], there[1], 1e-6);
    EXPECT_NEAR(back[0], back[1], 1e-6);
}

TEST_F(Navigation, PlannedFlightSlowsInBendsAndKeepsItsSpeedWhereTheWayIsStraight)
{
    constexpr double kStep_s = 0.02, kSpeed_mm_s = 100;
    navigator.setSpeed(kSpeed_mm_s);
    navigator.fly(1);
    NavigationState before = navigator.state();
    double fastest_mm_s = 0, slowest_mm_s = kSpeed_mm_s;
    while (!before.at_end) {
        navigator.advance(kStep_s);
        const NavigationState now = navigator.state();
        const double turned = std::acos(std::clamp(dot(now.pose.forward, before.pose.forward), -1.0, 1.0));
        EXPECT_LT(turned / kStep_s, radians(110)) << now.station_mm;  // 90, and what the eye beside the path adds
        const double speed_mm_s = (now.station_mm - before.station_mm) / kStep_s;
        fastest_mm_s = std::max(fastest_mm_s, speed_mm_s);
        if (!now.at_end)
            slowest_mm_s = std::min(slowest_mm_s, speed_mm_s);
        before = now;
    }
    EXPECT_NEAR(fastest_mm_s, kSpeed_mm_s, 1);
    EXPECT_LT(slowest_mm_s, 0.8 * kSpeed_mm_s);
}

TEST_F(Navigation, PlannedFlightStopsAtBothEndsAndStepsFollowTheHeading)
{
    navigator.setSpeed(100);
    navigator.fly(1);
    pass(60, 30);
    EXPECT_DOUBLE_EQ(navigator.state().station_mm, path.length_mm());
    EXPECT_TRUE(navigator.state().at_end);
    navigator.setHeading(Heading::rectum);
    navigator.step(10);
    EXPECT_NEAR(navigator.state().station_mm, path.length_mm() - 10, 1e-9);
    EXPECT_FALSE(navigator.state().at_end);
}

TEST_F(Navigation, LookingBackTurnsTheViewAndNotTheFlight)
{
    navigator.jumpTo(100);
    const Vector3 ahead = navigator.state().pose.forward;
    navigator.setLookBack(true);
    EXPECT_LT(dot(navigator.state().pose.forward, ahead), -0.5);
    navigator.fly(1);
    pass(1, 60);
    EXPECT_GT(navigator.state().station_mm, 110);
}

TEST_F(Navigation, FreeFlightNeverPassesThroughTheWall)
{
    for (const Steering& steering :
         {Steering{.thrust_forward = 1}, Steering{.thrust_right = 1}, Steering{.thrust_up = 1},
          Steering{.thrust_forward = 1, .thrust_right = -1, .thrust_up = 0.5},
          Steering{.turn_right = 0.3, .thrust_forward = 1}})
        for (const double station : {40.0, 200.0, 330.0}) {
            navigator.setMode(NavigationMode::free);
            navigator.jumpTo(station);
            navigator.setSpeed(100);
            const double first = navigator.state().clearance_mm;
            const Point3 begin = navigator.state().pose.eye_mm;
            navigator.steer(steering);
            double least = 1e9;
            for (int n = 0; n < 200; ++n) {
                navigator.advance(0.03);
                least = std::min(least, navigator.state().clearance_mm);
                ASSERT_TRUE(lumen.inside(navigator.state().pose.eye_mm));
            }
            EXPECT_GE(least, std::min(first, kCameraRadius_mm) - 1e-9);
            EXPECT_GT(distance(navigator.state().pose.eye_mm, begin), 1) << "it moves at all";
            navigator.steer({});
        }
}

TEST_F(Navigation, FreeFlightTurnsAtItsSpeedAndToTheSideThatIsAskedFor)
{
    navigator.setMode(NavigationMode::free);
    navigator.jumpTo(100);
    const Pose before = navigator.state().pose;
    navigator.steer({.turn_right = 1});
    pass(0.5, 240);
    const Vector3 after = navigator.state().pose.forward;
    EXPECT_NEAR(dot(after, before.forward), std::cos(radians(45)), 0.01);
    EXPECT_GT(dot(after, before.right()), 0.6);
    navigator.lookFrom(before, 100);
    navigator.steer({.turn_up = 1});
    pass(0.5, 240);
    EXPECT_GT(dot(navigator.state().pose.forward, before.up), 0.6);
}

TEST_F(Navigation, ASavedViewComesBackAndGuidedFlightBeginsAtItsStation)
{
    navigator.jumpTo(150);
    Pose saved = navigator.state().pose;
    saved.up = -saved.up;
    navigator.jumpTo(300);
    navigator.lookFrom(saved, 150);
    EXPECT_EQ(navigator.mode(), NavigationMode::free);
    EXPECT_EQ(navigator.state().pose.eye_mm, saved.eye_mm);
    EXPECT_EQ(navigator.state().pose.up, saved.up);
    navigator.setMode(NavigationMode::guided);
    EXPECT_NEAR(navigator.state().station_mm, 150, 3);
    saved.eye_mm = {1e4, 0, 0};
    navigator.lookFrom(saved, 150);
    EXPECT_TRUE(lumen.inside(navigator.state().pose.eye_mm)) << "an eye outside makes no sense";
}

}  // namespace
}  // namespace vicon::viewer
