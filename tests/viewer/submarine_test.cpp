#include <gtest/gtest.h>

#include <random>

#include "submarine_checks.h"

namespace vicon::viewer {
namespace {

using test::randomSteering;
using test::steerAtRandom;
using test::Submarines;

TEST_F(Submarines, NeverComeNearerToTheWallThanTheCamerasRadius)
{
    steerAtRandom(*this, 20000);
}

TEST_F(Submarines, FlyTheSamePathAtAnyFrameRate)
{
    const auto flown = [&](int rate) {
        Submarine boat = submarine();
        std::mt19937 random(9);
        std::vector<Point3> places;
        constexpr int kChanges = 60;  // a new hand every 1/6 s, where both rates have a frame
        for (int n = 0; n < kChanges; ++n) {
            Steering steering = randomSteering(random);
            steering.pull = 1;
            boat.steer(steering);
            for (int frame = 0; frame < rate / 6; ++frame)
                boat.advance(1.0 / rate);
            places.push_back(boat.state().pose.eye_mm);
        }
        return places;
    };
    const auto slow = flown(30), fast = flown(144);
    for (std::size_t n = 0; n < slow.size(); ++n)
        EXPECT_LT(distance(slow[n], fast[n]), 0.1) << n;
}

TEST_F(Submarines, LetGoAreBackOnThePathWithinTwoSeconds)
{
    std::mt19937 random(11);
    double farthest = 0;
    for (int n = 0; n < 30; ++n) {
        Submarine boat = submarine();
        boat.placeAt(path.length_mm() * (0.1 + 0.8 * n / 30), n % 2 ? Heading::caecum : Heading::rectum);
        Steering away = randomSteering(random);
        away.pull = 0;
        boat.steer(away);
        boat.advance(1);
        farthest = std::max(farthest, boat.state().off_path_mm);
        boat.steer({});
        boat.advance(2);
        const SubmarineState state = boat.state();
        EXPECT_LT(state.off_path_mm, 0.5) << n;
        const Vector3 ahead = path.at(state.station_mm).forward * (state.heading == Heading::caecum ? 1 : -1);
        EXPECT_GT(dot(state.pose.forward, ahead), 0.8) << n;
    }
    EXPECT_GT(farthest, 3);  // they had been off it
}

TEST_F(Submarines, PulledReachEitherEnd)
{
    for (const Heading heading : {Heading::caecum, Heading::rectum}) {
        Submarine boat = submarine();
        boat.placeAt(path.length_mm() / 2, heading);
        boat.steer({.pull = 1});
        double t = 0;
        for (; t < 60 && !boat.state().at_end; t += 0.1)
            boat.advance(0.1);
        EXPECT_TRUE(boat.state().at_end);
        EXPECT_LT(t, path.length_mm() / 2 / 30 * 1.6 + 2);  // near cruise speed
        EXPECT_NEAR(boat.state().station_mm, heading == Heading::caecum ? path.length_mm() : 0, 12);
    }
}

TEST_F(Submarines, AreCarriedOverACollapsedPartAndSaySo)
{
    // The lumen closed over 30 mm in the middle.
    const double from = path.length_mm() / 2 - 15, to = from + 30;
    InsideVolume inside = colon.inside;
    FieldVolume exit = colon.exit_distance;
    for (std::size_t n = 0; n < inside.voxels.size(); ++n)
        if (exit.voxels[n] >= from && exit.voxels[n] <= to) {
            inside.voxels[n] = kOutside;
            exit.voxels[n] = -1;
        }
    const FieldVolume wall = test::wallDistanceOf(inside);
    Submarine boat(path, Lumen(inside, wall), exit);
    boat.placeAt(from - 30, Heading::caecum);
    boat.steer({.pull = 1});
    bool carried = false;
    for (int n = 0; n < 240 * 10 && boat.state().station_mm < to + 20; ++n) {
        boat.advance(Submarine::kTick_s);
        const SubmarineState state = boat.state();
        carried = carried || state.carried;
        EXPECT_TRUE(state.carried || state.clearance_mm >= 2 || state.clearance_mm == 0) << n;
    }
    EXPECT_TRUE(carried);
    EXPECT_GT(boat.state().station_mm, to);
    EXPECT_FALSE(boat.state().carried);
}

}  // namespace
}  // namespace vicon::viewer
