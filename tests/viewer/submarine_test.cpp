#include <gtest/gtest.h>

#include <functional>

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

TEST_F(Submarines, ReleasedAreBackOnThePathWithinTwoSeconds)
{
    test::releasedAlong(course, 30);
}

TEST_F(Submarines, ReleasedComeToRestAfterSomeSeconds)
{
    for (double station = 20; station < path.length_mm() - 20; station += 37) {
        Submarine boat = submarine();
        boat.placeAt(station, Heading::caecum);
        boat.steer({.pull = 1, .turn_right = 0.5, .thrust_right = 0.5});
        boat.advance(1);
        boat.steer({});
        boat.advance(6);
        const Pose at_rest = boat.state().pose;
        boat.advance(0.5);
        EXPECT_EQ(boat.state().pose, at_rest) << "from " << station;
    }
}

TEST_F(Submarines, PulledReachEitherEnd)
{
    test::pullToBothEnds(course);
}

TEST_F(Submarines, AdriftReachEitherEndAndStayOffTheWall)
{
    for (const Heading heading : {Heading::caecum, Heading::rectum}) {
        Submarine boat = submarine();
        boat.placeAt(heading == Heading::caecum ? 0 : path.length_mm(), heading);
        boat.steer({.drift = 1});
        for (int n = 0; n < 240 * 60 && !boat.state().at_end; ++n) {
            boat.advance(Submarine::kTick_s);
            ASSERT_GE(boat.state().clearance_mm, test::leastClearance_mm(course, boat.state())) << n;
        }
        EXPECT_TRUE(boat.state().at_end) << boat.state().station_mm;
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
        EXPECT_TRUE(state.carried || state.clearance_mm >= 2) << n;
    }
    EXPECT_TRUE(carried);
    EXPECT_GT(boat.state().station_mm, to);
    EXPECT_FALSE(boat.state().carried);
}

/// A straight lumen of 52 x 34 mm along the body, its path in the middle, and what is built into it.
struct Hall {
    InsideVolume inside;
    FieldVolume wall, exit;
    Skeleton skeleton;

    /// @param solid whether there is wall at that place: to the left, to the back and along from the rectal end
    explicit Hall(const std::function<bool(double, double, double)>& solid)
    {
        Grid grid;
        grid.size = {56, 38, 164};
        grid.spacing_mm = {1, 1, 1};
        grid.origin_mm = {-27.5, -18.5, -2};
        inside = InsideVolume(grid);
        exit = FieldVolume(grid, -1);
        for (std::size_t n = 0; n < inside.voxels.size(); ++n) {
            const Point3 p = grid.pointAt(grid.indexOf(n));
            if (std::abs(p.x) > 26 || std::abs(p.y) > 17 || p.z < -0.5 || p.z > 160 || solid(p.x, p.y, p.z))
                continue;
            inside.voxels[n] = kGas;
            exit.voxels[n] = float(p.z);
        }
        wall = test::wallDistanceOf(inside);
        SkeletonPiece piece;
        for (int z = 5; z <= 155; ++z)
            piece.points.push_back({{0, 0, double(z)}, double(z - 5), 17});
        skeleton.pieces = {piece};
    }
};

struct InAHall {
    Hall hall;
    PathFrames path{hall.skeleton};
    CellSurface no_surface;
    test::Course course{path, Lumen(hall.inside, hall.wall), hall.exit, no_surface};
    Submarine boat{course.submarine()};

    explicit InAHall(const std::function<bool(double, double, double)>& solid) : hall(solid) {}

    // For so long, never too near to the wall.
    void steer(const Steering& steering, double seconds)
    {
        boat.steer(steering);
        for (int n = 0; n < int(seconds / Submarine::kTick_s); ++n) {
            boat.advance(Submarine::kTick_s);
            const SubmarineState state = boat.state();
            ASSERT_GE(state.clearance_mm, test::leastClearance_mm(course, state)) << n << " at " << state.station_mm;
        }
    }
};

bool neck(double x, double y, double z)
{
    return z > 70 && z < 76 && std::max(std::abs(x), std::abs(y)) > 1.8;
}

TEST(SubmarinesInAHall, AreCarriedThroughANeckNoNearerToTheWallThanThePath)
{
    for (const Heading heading : {Heading::caecum, Heading::rectum}) {
        InAHall in(neck);
        in.boat.placeAt(heading == Heading::caecum ? 60 : 76, heading);
        in.steer({.pull = 1, .thrust_right = 0.8}, 0.35);  // into it beside the path
        in.steer({.pull = 1}, 5);
        EXPECT_FALSE(in.boat.state().carried);
        EXPECT_GT((in.boat.state().station_mm - 68) * (heading == Heading::caecum ? 1 : -1), 20) << "it is through";
    }
}

TEST(SubmarinesInAHall, ReleasedBesideANeckMakeForWhereThePathIsWide)
{
    InAHall in(neck);
    in.boat.placeAt(60, Heading::caecum);
    in.steer({.thrust_forward = 1, .thrust_right = 1, .thrust_up = 0.5}, 1.5);
    EXPECT_GT(in.boat.state().off_path_mm, 10);
    in.steer({}, 2);
    EXPECT_LT(in.boat.state().off_path_mm, 0.5);
    EXPECT_GE(in.boat.state().clearance_mm, 2);
}

TEST(SubmarinesInAHall, ReleasedComeToRestSoonAndQuite)
{
    InAHall in([](double, double, double) { return false; });
    in.boat.placeAt(30, Heading::caecum);
    in.steer({.pull = 1, .turn_right = 0.5, .thrust_right = 0.5}, 1);
    in.steer({}, 5);
    const Pose at_rest = in.boat.state().pose;
    in.steer({}, 0.1);
    EXPECT_EQ(in.boat.state().pose, at_rest);
}

TEST(SubmarinesInAHall, ReleasedInAPouchFindTheirWayOut)
{
    // Plates on either side of the path, and the space behind them closed towards the caecum.
    InAHall in([](double x, double, double z) {
        return (std::abs(std::abs(x) - 9) < 1 && z > 60 && z < 92) || (std::abs(x) > 8 && z > 88 && z < 92);
    });
    in.boat.placeAt(45, Heading::caecum);
    in.steer({.thrust_right = 1}, 1);
    in.steer({.thrust_forward = 1, .thrust_right = 0.3}, 2);
    EXPECT_GT(in.boat.state().off_path_mm, 12);
    EXPECT_GT(in.boat.state().pose.eye_mm.z, 80);
    in.steer({}, 2);
    EXPECT_LT(in.boat.state().off_path_mm, 0.5);
}

TEST(SubmarinesInAHall, ReachAnEndThatIsNarrowerThanTheyAre)
{
    InAHall in([](double x, double y, double z) { return z < 40 && std::max(std::abs(x), std::abs(y)) > 1.8; });
    in.boat.placeAt(80, Heading::rectum);
    in.steer({.pull = 1}, 5);
    EXPECT_TRUE(in.boat.state().at_end);
    EXPECT_NEAR(in.boat.state().station_mm, 0, 1);
    EXPECT_TRUE(in.boat.state().carried) << "and say so";
    in.steer({.pull = -1}, 5);
    EXPECT_GT(in.boat.state().station_mm, 60) << "and come back";
}

TEST(SubmarinesInAHall, ArePulledAlsoWhereTheDistanceFromTheExitGrows)
{
    for (const double tilt : {1.0, -1.0}) {
        InAHall in([](double, double, double) { return false; });
        for (std::size_t n = 0; n < in.hall.exit.voxels.size(); ++n) {
            const Point3 p = in.hall.exit.grid.pointAt(in.hall.exit.grid.indexOf(n));
            if (in.hall.inside.voxels[n])
                in.hall.exit.voxels[n] = float(200 + p.z + tilt * p.x);
        }
        in.boat.placeAt(60, Heading::caecum);
        in.steer({.pull = 1, .thrust_up = 1e-6}, 0.5);  // a hand on it: nothing draws it back to its path
        const Vector3 velocity = in.boat.state().velocity_mm_s;
        // Two parts of the path's direction, one of the gradient's, which lies at 45 degrees to it.
        const double expected = std::sqrt(0.5) / (2 + std::sqrt(0.5));
        EXPECT_NEAR(velocity.x / velocity.z, tilt * expected, 0.02);
    }
}

/// Makes the distance from the exit grow in that direction.
void tilt(Hall& hall, Vector3 slope)
{
    for (std::size_t n = 0; n < hall.exit.voxels.size(); ++n)
        if (hall.inside.voxels[n])
            hall.exit.voxels[n] = float(200 + dot(hall.exit.grid.pointAt(hall.exit.grid.indexOf(n)) - Point3{}, slope));
}

TEST(SubmarinesInAHall, AdriftGoWhereTheDistanceFromTheExitGrowsAndNotAtAllWhereItIsFlat)
{
    for (const Vector3 slope : {Vector3{0.6, 0, 0.8}, Vector3{-0.6, 0, 0.8}, Vector3{0, 0.6, 0.8}}) {
        InAHall in([](double, double, double) { return false; });
        tilt(in.hall, slope);
        in.boat.placeAt(60, Heading::caecum);
        in.steer({.drift = 1}, 0.2);
        const Vector3 went = in.boat.state().pose.eye_mm - in.path.at(60).position_mm;
        EXPECT_GT(length(went), 1);
        EXPECT_LT(length(normalized(went) - slope), 0.02);
    }
    InAHall flat([](double, double, double) { return false; });
    tilt(flat.hall, {});
    flat.boat.placeAt(60, Heading::caecum);
    flat.steer({.drift = 1}, 0.9);
    EXPECT_LT(distance(flat.boat.state().pose.eye_mm, flat.path.at(60).position_mm), 1e-6);
    flat.steer({.drift = 1}, 20);
    EXPECT_TRUE(flat.boat.state().at_end) << "where nothing leads on, the path does";
}

TEST(SubmarinesInAHall, AdriftAreHeldOffTheWallWhereBothPotentialsAreEqual)
{
    const double reach = Submarine::kWallShare * 17;
    const Vector3 slope = normalized(Vector3{1, 0, 0.4});
    const double pulled = slope.x * Submarine::kCruise_mm_s * Submarine::kFriction_per_s;
    const auto push = [&](double wall) {
        return 2 * Submarine::kWallStrength_mm2_s2 * (reach / wall - 1) * reach / (wall * wall);
    };
    double near = kCameraRadius_mm, far = reach;
    for (int n = 0; n < 60; ++n)
        (push((near + far) / 2) > pulled ? near : far) = (near + far) / 2;
    ASSERT_GT(near, kCameraRadius_mm + 1);
    InAHall in([](double, double, double) { return false; });
    tilt(in.hall, slope);
    in.boat.placeAt(30, Heading::caecum);
    in.steer({.drift = 1}, 4);
    EXPECT_NEAR(in.boat.state().clearance_mm, near, 0.4);
    EXPECT_GT(in.boat.state().off_path_mm, 15) << "nothing draws it back to the path";
    in.steer({}, 2);
    EXPECT_LT(in.boat.state().off_path_mm, 0.5) << "but when it is let go";
}

TEST(SubmarinesInAHall, ArePushedOffTheWallAgainstTheHand)
{
    const double reach = Submarine::kWallShare * 17, hand = Submarine::kThrust_mm_s * Submarine::kFriction_per_s;
    const auto push = [&](double wall) {  // the gradient of strength x (reach / wall - 1)^2
        return 2 * Submarine::kWallStrength_mm2_s2 * (reach / wall - 1) * reach / (wall * wall);
    };
    double near = kCameraRadius_mm, far = reach;  // between them both forces are equal
    for (int n = 0; n < 60; ++n)
        (push((near + far) / 2) > hand ? near : far) = (near + far) / 2;
    ASSERT_GT(near, kCameraRadius_mm + 1) << "farther than where it could not go on anyhow";
    InAHall in([](double, double, double) { return false; });
    in.boat.placeAt(60, Heading::caecum);
    in.steer({.thrust_right = 1}, 4);
    EXPECT_NEAR(in.boat.state().clearance_mm, near, 0.3);
}

}  // namespace
}  // namespace vicon::viewer
