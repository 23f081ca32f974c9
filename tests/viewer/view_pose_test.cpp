#include <gtest/gtest.h>

#include <random>

#include "test_colon.h"
#include "vicon/viewer/model/flight_plan.h"
#include "vicon/viewer/model/view_pose.h"

namespace vicon::viewer {
namespace {

struct ViewPoses : testing::Test {
    test::TestColon colon;
    PathFrames path{colon.skeleton};
    Lumen lumen{colon.inside, colon.wall_distance};

    void expectFlyable(const ViewPose& view) const
    {
        EXPECT_TRUE(lumen.inside(view.pose.eye_mm));
        EXPECT_GE(lumen.clearance_mm(view.pose.eye_mm), kCameraRadius_mm);
        EXPECT_NEAR(length(view.pose.forward), 1, 1e-9);
        EXPECT_NEAR(dot(view.pose.forward, view.pose.up), 0, 1e-9);
    }
};

TEST_F(ViewPoses, EveryStationHasAnEyeInTheLumenThatLooksAlongThePath)
{
    for (double s = -5; s <= path.length_mm() + 5; s += 2)
        for (const Heading heading : {Heading::caecum, Heading::rectum}) {
            const ViewPose view = poseAtStation(path, lumen, s, heading);
            expectFlyable(view);
            const double along = dot(view.pose.forward, path.at(view.station_mm).forward);
            EXPECT_GT(heading == Heading::caecum ? along : -along, 0.5) << s;
        }
}

TEST_F(ViewPoses, APolypIsInTheMiddleAndInPlainView)
{
    const ViewPose view = poseForPoint(colon.skeleton, path, lumen, colon.polyp_mm);
    expectFlyable(view);
    EXPECT_TRUE(view.sees_target);
    const Lens lens{90, 640, 480};
    const Projected p = project(view.pose, lens, colon.polyp_mm);
    EXPECT_NEAR(p.at.x, 320, 1e-6);
    EXPECT_NEAR(p.at.y, 240, 1e-6);
    const double d = distance(view.pose.eye_mm, colon.polyp_mm);
    EXPECT_GE(d, kLeastDistance_mm / 2);
    EXPECT_LE(d, 1.3 * kMostDistance_mm);
    // The line of sight is free up to the polyp's surface.
    const Vector3 direction = normalized(colon.polyp_mm - view.pose.eye_mm);
    for (double at = 0; at < d - colon.polyp_radius_mm - 2; at += 0.5)
        EXPECT_TRUE(lumen.inside(view.pose.eye_mm + direction * at));
}

TEST_F(ViewPoses, AnyPointOfTheWallIsSeenFromWithinTheLumen)
{
    std::mt19937 random(7);
    std::uniform_int_distribution<std::size_t> any(0, colon.cells.pointCount() - 1);
    int seen = 0;
    constexpr int kTries = 60;
    for (int n = 0; n < kTries; ++n) {
        const ViewPose view = poseForPoint(colon.skeleton, path, lumen, colon.cells.point(any(random)));
        expectFlyable(view);
        seen += view.sees_target;
    }
    EXPECT_GE(seen, kTries * 95 / 100);  // a few lie deep behind a fold
}

TEST_F(ViewPoses, ABridgeIsNotFlownThrough)
{
    // The curve's middle declared a bridge: stations there are shown from its ends.
    SkeletonPiece whole = colon.skeleton.pieces.front();
    Skeleton cut;
    for (int part = 0; part < 3; ++part) {
        const std::size_t from = whole.points.size() * std::size_t(part) / 3;
        const std::size_t to = part == 2 ? whole.points.size() - 1 : whole.points.size() * std::size_t(part + 1) / 3;
        cut.pieces.push_back(
            {part == 1, {whole.points.begin() + std::ptrdiff_t(from), whole.points.begin() + std::ptrdiff_t(to) + 1}});
    }
    const PathFrames frames(cut);
    const double from = cut.pieces[1].points.front().station_mm, to = cut.pieces[1].points.back().station_mm;
    const ViewPose view = poseAtStation(frames, lumen, (from + to) / 2 - 1);
    EXPECT_LE(view.station_mm, from + 1);
    for (const ViewPose& pose : planFlight(frames, lumen, 2, Heading::caecum))
        EXPECT_TRUE(pose.station_mm <= from + 1 || pose.station_mm >= to - 1) << pose.station_mm;
}

TEST_F(ViewPoses, AFlightTurnsSmoothlyAndCoversTheWholePath)
{
    for (const Heading heading : {Heading::caecum, Heading::rectum}) {
        const auto poses = planFlight(path, lumen, 1, heading);
        ASSERT_GT(poses.size(), 100U);
        const double first = poses.front().station_mm, last = poses.back().station_mm;
        EXPECT_NEAR(heading == Heading::caecum ? first : last, 0, 3);
        EXPECT_NEAR(heading == Heading::caecum ? last : first, path.length_mm(), 3);
        for (std::size_t n = 1; n < poses.size(); ++n) {
            expectFlyable(poses[n]);
            EXPECT_GT(dot(poses[n].pose.forward, poses[n - 1].pose.forward), std::cos(radians(6))) << n;
            EXPECT_GT(dot(poses[n].pose.up, poses[n - 1].pose.up), std::cos(radians(8))) << n;
        }
    }
}

}  // namespace
}  // namespace vicon::viewer
