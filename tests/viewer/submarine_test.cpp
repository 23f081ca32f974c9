#include <gtest/gtest.h>

#include "submarine_checks.h"

namespace vicon::viewer {
namespace {

using test::Submarines;

TEST_F(Submarines, NeverComeNearerToTheWallThanTheCamerasRadius)
{
    EXPECT_EQ(test::steerAtRandom(course, 20000), 0);  // nothing is collapsed
}

TEST_F(Submarines, FlyTheSamePathAtAnyFrameRate)
{
    test::flyAtTwoRates(course, 0, 9);
}

TEST_F(Submarines, LetGoAreBackOnThePathWithinTwoSeconds)
{
    test::letGoAlong(course, 30);
}

TEST_F(Submarines, PulledReachEitherEnd)
{
    test::pullToBothEnds(course);
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
