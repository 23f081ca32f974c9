#pragma once

#include <gtest/gtest.h>

#include <random>

#include "test_colon.h"
#include "vicon/viewer/model/submarine.h"

namespace vicon::viewer::test {

/// What a camera flies through, and the wall's surface to judge by.
struct Course {
    const PathFrames& path;
    Lumen lumen;
    FieldView exit_distance;
    const CellSurface& wall;

    Submarine submarine() const { return {path, lumen, exit_distance}; }
    // Distance to the nearest point of the wall's surface, independent of the field that the camera steers by.
    double wallDistance(Point3 p) const
    {
        double best = 1e300;
        for (std::size_t n = 0; n < wall.pointCount(); ++n) {
            const Vector3 d = wall.point(n) - p;
            best = std::min(best, dot(d, d));
        }
        return std::sqrt(best);
    }
};

struct Submarines : testing::Test {
    TestColon colon;
    PathFrames path{colon.skeleton};
    Lumen lumen{colon.inside, colon.wall_distance};
    Course course{path, lumen, colon.exit_distance, colon.cells};

    Submarine submarine() const { return course.submarine(); }
};

inline Steering randomSteering(std::mt19937& random)
{
    std::uniform_real_distribution<double> any(-1, 1);
    return {any(random), any(random), any(random), any(random), any(random), any(random)};
}

/// How near to the wall a camera may be: its radius or, while it is carried through a narrower part, what the path has.
inline double leastClearance_mm(const Course& course, const SubmarineState& state)
{
    const double radius = kCameraRadius_mm;
    const double path = course.lumen.clearance_mm(course.path.at(state.station_mm).position_mm);
    constexpr double kRounding_mm = 1e-6;
    return (state.carried ? std::min(radius, path) : radius) - kRounding_mm;
}

/// Random hands for that many ticks, pulled up and down the colon; the whole proof is a million.
/// @param wall_every ticks between measurements against the surface itself
/// @return ticks during which the camera was carried through a part that is collapsed or narrower than itself
inline int steerAtRandom(const Course& course, int ticks, int wall_every = 100)
{
    Submarine boat = course.submarine();
    boat.placeAt(course.path.length_mm() / 2, Heading::caecum);
    std::mt19937 random(5);
    double travelled = 0;
    int carried = 0;
    Point3 last = boat.state().pose.eye_mm;
    for (int n = 0; n < ticks; ++n) {
        constexpr int kSweep = 20000;
        if (n % 40 == 0) {
            Steering steering = randomSteering(random);
            steering.pull = std::abs(steering.pull) * (n / kSweep % 2 == 0 ? 1 : -1);
            boat.steer(steering);
        }
        boat.advance(Submarine::kTick_s);
        const SubmarineState state = boat.state();
        carried += state.carried ? 1 : 0;
        EXPECT_GE(state.clearance_mm, leastClearance_mm(course, state))
            << "tick " << n << " at " << state.station_mm << (state.carried ? ", carried" : "");
        if (n % wall_every == 0 && !state.carried) {
            EXPECT_GE(course.wallDistance(state.pose.eye_mm), 2) << "tick " << n;
        }
        if (testing::Test::HasFailure())
            break;
        travelled += distance(state.pose.eye_mm, last);
        last = state.pose.eye_mm;
    }
    EXPECT_GT(travelled, ticks * Submarine::kTick_s * 3);  // it did move
    return carried;
}

/// Ten seconds by random hands at two frame rates.
inline void flyAtTwoRates(const Course& course, double from_station_mm, unsigned seed)
{
    const auto flown = [&](int rate) {
        Submarine boat = course.submarine();
        boat.placeAt(from_station_mm, Heading::caecum);
        std::mt19937 random(seed);
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
        EXPECT_LT(distance(slow[n], fast[n]), 0.1) << "from " << from_station_mm << ", change " << n;
}

inline void expectReachesEnd(Submarine& boat, double station_mm, double length_mm)
{
    boat.steer({.pull = 1});
    const double rest = boat.state().heading == Heading::caecum ? length_mm - station_mm : station_mm;
    double t = 0;
    for (; t < 200 && !boat.state().at_end; t += 0.1)
        boat.advance(0.1);
    EXPECT_TRUE(boat.state().at_end) << "from " << station_mm;
    EXPECT_LT(t, rest / 30 * 1.6 + 2) << "near cruise speed, from " << station_mm;
}

/// Steered away from the path for a second at many places, then let go; back on it, it is pulled to its end.
inline void releasedAlong(const Course& course, int places)
{
    std::mt19937 random(11);
    double farthest = 0;
    for (int n = 0; n < places; ++n) {
        Submarine boat = course.submarine();
        boat.placeAt(course.path.length_mm() * (0.1 + 0.8 * n / places), n % 2 ? Heading::caecum : Heading::rectum);
        Steering away = randomSteering(random);
        away.pull = 0;
        boat.steer(away);
        boat.advance(1);
        farthest = std::max(farthest, boat.state().off_path_mm);
        boat.steer({});
        boat.advance(2);
        const SubmarineState state = boat.state();
        EXPECT_LT(state.off_path_mm, 0.5) << n << " at " << state.station_mm;
        // It looks where the lumen opens, as it does in flight.
        const Vector3 ahead =
            LookAhead(course.path, course.lumen).direction(state.station_mm, state.pose.eye_mm, state.heading);
        EXPECT_GT(dot(state.pose.forward, ahead), 0.9) << n << " at " << state.station_mm;
        if (n % 5 == 0)
            expectReachesEnd(boat, state.station_mm, course.path.length_mm());
    }
    EXPECT_GT(farthest, 3);  // they had been off it
}

/// Pulled from the middle, both ways.
inline void pullToBothEnds(const Course& course)
{
    for (const Heading heading : {Heading::caecum, Heading::rectum}) {
        const double length = course.path.length_mm();
        Submarine boat = course.submarine();
        boat.placeAt(length / 2, heading);
        expectReachesEnd(boat, length / 2, length);
        EXPECT_NEAR(boat.state().station_mm, heading == Heading::caecum ? length : 0, 2);
    }
}

}  // namespace vicon::viewer::test
