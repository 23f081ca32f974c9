// Flight in a cavity without a path, pushed off the wall by its potential, against a lumen of closed form.
#include "vicon/viewer/model/free_flight.h"

#include <gtest/gtest.h>

#include <random>

#include "vicon/core/error.h"
#include "vicon/steps/wall_distance.h"
#include "vicon/viewer/model/flight_plan.h"
#include "vicon/viewer/model/home_place.h"
#include "vicon/viewer/model/navigator.h"
#include "vicon/viewer/model/tracked_lumen.h"

namespace vicon::viewer {
namespace {

constexpr double kCamera_mm = kCameraRadius_mm;

/// An ellipsoid with folds, and a wall of 1.6 mm across it that is open above.
bool insideCavity(Point3 p)
{
    const double ellipsoid = std::hypot(p.x / 60, p.y / 42, p.z / 36);
    const double fold = std::pow(std::max(0.0, std::cos(2 * std::numbers::pi * (p.x + 3 * std::sin(p.z / 9)) / 21)), 6);
    const bool partition = std::abs(p.x - 10) < 0.8 && p.z < 8;
    return ellipsoid < 1 - 0.16 * fold && !partition;
}

struct Cavity {
    InsideVolume inside{Grid{.size = {128, 92, 80}, .origin_mm = {-63.5, -45.5, -39.5}, .spacing_mm = {1, 1, 1}}};
    FieldVolume wall_distance;

    Cavity()
    {
        for (std::size_t n = 0; n < inside.voxels.size(); ++n)
            inside.voxels[n] = insideCavity(inside.grid.pointAt(inside.grid.indexOf(n))) ? kGas : kOutside;
        NoProgress quiet;
        wall_distance = steps::wallDistance(inside, quiet);
    }
};

struct FreeInCavity : testing::Test {
    static const Cavity& cavity()
    {
        static const Cavity kCavity;
        return kCavity;
    }
    Lumen lumen{cavity().inside, cavity().wall_distance};
    PathFrames none = PathFrames::withoutPath(homePlace(lumen, cavity().wall_distance));
    Navigator navigator{none, lumen, std::nullopt};
    std::mt19937 random{7};

    double draw(double low, double high) { return std::uniform_real_distribution(low, high)(random); }
    Vector3 direction()
    {
        for (;;)
            if (const Vector3 v{draw(-1, 1), draw(-1, 1), draw(-1, 1)}; length(v) > 0.1 && length(v) < 1)
                return normalized(v);
    }
    Pose somewhere(double room_mm)
    {
        for (;;)
            if (const Point3 p{draw(-60, 60), draw(-42, 42), draw(-36, 36)};
                lumen.inside(p) && lumen.clearance_mm(p) >= room_mm) {
                const Vector3 forward = direction();
                return {p, forward, uprightOn(forward, direction())};
            }
    }
    /// Keys as a reader presses them: each held, or not.
    Steering keys()
    {
        const auto key = [this] { return double(int(draw(0, 3)) - 1); };
        Steering s;
        s.thrust_forward = key();
        s.thrust_right = key();
        s.turn_right = key();
        s.turn_up = key();
        return s;
    }
    /// Whether a ball of the camera's size around the eye holds nothing but lumen, by the closed form.
    bool ballIsFree(Point3 eye)
    {
        for (int n = 0; n < 40; ++n)
            if (const Vector3 ray = direction(); !insideCavity(eye + ray * (kCamera_mm * draw(0.2, 1))))
                return false;
        return insideCavity(eye);
    }
};

TEST_F(FreeInCavity, AThousandFlightsNeverLeaveTheLumenNorComeNearerThanTheCamerasRadius)
{
    double farthest_mm = 0, nearest_mm = 1e9;
    for (int flight = 0; flight < 1000; ++flight) {
        navigator.lookFrom(somewhere(4), 0);
        navigator.setSpeed(draw(Navigator::kLeastSpeed_mm_s, Navigator::kMostSpeed_mm_s));
        const Point3 from = navigator.state().pose.eye_mm;
        for (int moment = 0; moment < 16; ++moment) {
            navigator.steer(keys());
            if (draw(0, 1) < 0.1)
                navigator.step(draw(-15, 15));
            if (draw(0, 1) < 0.1)
                navigator.moveBy(direction() * draw(0, 20));
            for (int n = 0; n < 4; ++n) {
                navigator.advance(draw(0.004, 0.15));
                const NavigationState now = navigator.state();
                ASSERT_TRUE(ballIsFree(now.pose.eye_mm)) << flight << ": " << now.clearance_mm;
                nearest_mm = std::min(nearest_mm, now.clearance_mm);
            }
        }
        farthest_mm = std::max(farthest_mm, distance(from, navigator.state().pose.eye_mm));
    }
    EXPECT_GT(farthest_mm, 60) << "it flies";
    EXPECT_LT(nearest_mm, 5) << "and comes near enough to look closely";
}

TEST_F(FreeInCavity, WhatIsLetGoNearTheWallIsPushedOffItAndComesToRest)
{
    navigator.lookFrom({{-20, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0);
    Steering on;
    on.thrust_forward = 1;
    navigator.steer(on);
    navigator.advance(4);
    const double pressed_mm = navigator.state().clearance_mm;
    EXPECT_LT(pressed_mm, FreeFlight::kWallReach_mm - 2);
    EXPECT_GT(pressed_mm, kCamera_mm);
    navigator.steer({});
    navigator.advance(4);
    EXPECT_GT(navigator.state().clearance_mm, pressed_mm + 1.5);
    EXPECT_GT(navigator.state().clearance_mm, 0.8 * FreeFlight::kWallReach_mm);
    const Point3 rest = navigator.state().pose.eye_mm;
    navigator.advance(20);
    EXPECT_LT(distance(navigator.state().pose.eye_mm, rest), 1);
}

TEST_F(FreeInCavity, AnEyeThatIsPutTooNearTheWallBacksOff)
{
    for (int n = 0; n < 30; ++n) {
        Pose at = somewhere(0.6);
        while (lumen.clearance_mm(at.eye_mm) > 1.5)
            at = somewhere(0.6);
        navigator.lookFrom(at, 0);
        navigator.advance(3);
        EXPECT_TRUE(lumen.inside(navigator.state().pose.eye_mm));
        EXPECT_GT(navigator.state().clearance_mm, lumen.clearance_mm(at.eye_mm));
    }
}

TEST_F(FreeInCavity, NoOtherModeIsTakenAndAJumpGoesHome)
{
    EXPECT_FALSE(navigator.hasPath());
    const NavigationState home = navigator.state();
    EXPECT_GT(home.clearance_mm, 20);
    for (const NavigationMode mode : {NavigationMode::planned, NavigationMode::guided}) {
        navigator.setMode(mode);
        EXPECT_EQ(navigator.mode(), NavigationMode::free);
    }
    navigator.fly(1);
    navigator.advance(2);
    EXPECT_LT(distance(navigator.state().pose.eye_mm, home.pose.eye_mm), 1e-9);
    const Navigator::Place before = navigator.place();
    navigator.lookFrom(somewhere(5), 0);
    navigator.goBackTo(before);
    EXPECT_EQ(navigator.state().pose, home.pose);
    navigator.lookFrom(somewhere(5), 0);
    navigator.jumpTo(123);
    EXPECT_EQ(navigator.state().pose, home.pose);
    EXPECT_EQ(navigator.state().station_mm, 0);
}

TEST_F(FreeInCavity, WhatIsReachedDoesNotDependOnTheFrameRate)
{
    std::vector<Point3> reached;
    for (const double rate_hz : {30.0, 144.0}) {
        navigator.jumpTo(0);
        Steering steering;
        steering.thrust_forward = steering.turn_right = 1;
        navigator.steer(steering);
        for (int n = 0; n < int(rate_hz) * 3; ++n)
            navigator.advance(1 / rate_hz);
        reached.push_back(navigator.state().pose.eye_mm);
    }
    EXPECT_LT(distance(reached[0], reached[1]), 0.5);
}

TEST_F(FreeInCavity, HomeIsTheWidestPlaceAndLooksWhereItIsDeepest)
{
    const PathFrame home = none.at(0);
    for (const float mm : cavity().wall_distance.voxels)
        ASSERT_LE(mm, home.radius_mm);
    EXPECT_TRUE(lumen.sees(home.position_mm, home.position_mm + home.forward * 25));
    EXPECT_NEAR(dot(home.forward, home.up), 0, 1e-9);
    EXPECT_EQ(none.nearestStation({1, 2, 3}, 0, 30), 0);
    const InsideVolume empty(cavity().inside.grid);
    const FieldVolume zero(empty.grid);
    EXPECT_THROW(homePlace(Lumen(empty, zero), zero), Error);
}

TEST_F(FreeInCavity, APlaceOfTheWallIsLookedAtFromInside)
{
    for (const Point3 wall : {Point3{-59, 0, 0}, Point3{0, 41, 0}, Point3{-10, 0, -35}}) {
        const ViewPose view = poseForPoint({}, none, lumen, wall);
        EXPECT_TRUE(view.sees_target);
        EXPECT_TRUE(insideCavity(view.pose.eye_mm));
        EXPECT_LT(std::acos(dot(view.pose.forward, normalized(wall - view.pose.eye_mm))), 0.01);
        EXPECT_EQ(view.station_mm, 0);
    }
    const auto place = roomiestAlong(lumen, {-30, 300, 0}, {0, 1, 0});
    ASSERT_TRUE(place);
    EXPECT_LT(std::abs(place->y), 12);
    EXPECT_FALSE(roomiestAlong(lumen, {-30, 0, 60}, {0, 1, 0}));
}

TEST_F(FreeInCavity, WhatNeedsAPathSaysSo)
{
    EXPECT_THROW(planFlight(none, lumen, 5, Heading::caecum), Error);
    const Pose eye = navigator.state().pose;
    const SliceAxes across = axesAcross(none, {0, 0, 0}, eye);
    EXPECT_NEAR(std::abs(dot(cross(across.right, across.down), eye.forward)), 1, 1e-9) << "across the view";
}

}  // namespace
}  // namespace vicon::viewer
