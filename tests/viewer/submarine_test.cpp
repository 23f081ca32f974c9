#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "test_colon.h"
#include "vicon/viewer/model/submarine.h"

namespace vicon::viewer {
namespace {

struct Submarines : testing::Test {
    test::TestColon colon;
    PathFrames path{colon.skeleton};
    Lumen lumen{colon.inside, colon.wall_distance};

    Submarine submarine(const SubmarineOptions& options = {}) const
    {
        return {path, lumen, colon.exit_distance, options};
    }
    // Distance to the nearest point of the wall's surface, independent of the field that the camera steers by.
    double wallDistance(Point3 p) const
    {
        double best = 1e300;
        for (std::size_t n = 0; n < colon.cells.pointCount(); ++n) {
            const Vector3 d = colon.cells.point(n) - p;
            best = std::min(best, dot(d, d));
        }
        return std::sqrt(best);
    }
};

Steering randomSteering(std::mt19937& random)
{
    std::uniform_real_distribution<double> any(-1, 1);
    return {any(random), any(random), any(random), any(random), any(random), any(random)};
}

// Random hands for that many ticks; the whole proof is the test of label "long".
void steerAtRandom(const Submarines& s, int ticks)
{
    Submarine boat = s.submarine();
    boat.placeAt(s.path.length_mm() / 2, Heading::caecum);
    std::mt19937 random(5);
    double travelled = 0;
    Point3 last = boat.state().pose.eye_mm;
    for (int n = 0; n < ticks; ++n) {
        if (n % 40 == 0)
            boat.steer(randomSteering(random));
        boat.advance(Submarine::kTick_s);
        const SubmarineState state = boat.state();
        ASSERT_GE(state.clearance_mm, 2) << "tick " << n;
        if (n % 100 == 0) {
            ASSERT_GE(s.wallDistance(state.pose.eye_mm), 2) << "tick " << n;
        }
        travelled += distance(state.pose.eye_mm, last);
        last = state.pose.eye_mm;
    }
    EXPECT_GT(travelled, ticks * Submarine::kTick_s * 3);  // it did move
}

TEST_F(Submarines, NeverComeNearerToTheWallThanTheCamerasRadius)
{
    steerAtRandom(*this, 20000);
}

TEST_F(Submarines, LongRandomSteeringNeverComesNearerToTheWallThanTheCamerasRadius)
{
    if (!std::getenv("VICON_LONG_TESTS"))
        GTEST_SKIP() << "one million ticks: set VICON_LONG_TESTS=1";
    steerAtRandom(*this, 1000000);
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
