#pragma once

#include <gtest/gtest.h>

#include <random>

#include "test_colon.h"
#include "vicon/viewer/model/submarine.h"

namespace vicon::viewer::test {

struct Submarines : testing::Test {
    TestColon colon;
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

inline Steering randomSteering(std::mt19937& random)
{
    std::uniform_real_distribution<double> any(-1, 1);
    return {any(random), any(random), any(random), any(random), any(random), any(random)};
}

// Random hands for that many ticks; the whole proof is a million.
inline void steerAtRandom(const Submarines& s, int ticks)
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

}  // namespace vicon::viewer::test
