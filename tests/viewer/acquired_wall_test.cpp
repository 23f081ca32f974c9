// The wall as acquired: tagged fluid stands where it stood.
#include "vicon/viewer/model/acquired_wall.h"

#include "snapshot_fixture.h"
#include "vicon/scan_files/description_file.h"
#include "vicon/viewer/model/camera.h"
#include "vicon/viewer/model/peeling.h"
#include "vicon/viewer/scene/surface_scene.h"

namespace vicon::viewer {
namespace {

using namespace test;

struct AcquiredWall : Shooting<ColonFixture> {
    SnapshotRequest request;

    AcquiredWall()
    {
        request.station_mm = 150;
        request.width = request.height = 300;
        request.captioned = false;
    }

    /// The picture's eye; the colon's own.
    SnapshotResult place()
    {
        SnapshotResult found;
        shoot(scan(), request, &found);
        return found;
    }

    /// Tagged fluid in all of the lumen that lies more than this far ahead of `eye`, its level across the view.
    void fillAhead(const Pose& eye, double from_mm)
    {
        for (std::size_t n = 0; n < colon.volume.voxels.size(); ++n) {
            const Grid& grid = colon.volume.grid;
            if (colon.inside.voxels[n] != kOutside &&
                dot(grid.pointAt(grid.indexOf(n)) - eye.eye_mm, eye.forward) > from_mm)
                colon.volume.voxels[n] = 500;
        }
    }
};

TEST_F(AcquiredWall, IsTheSurfaceWhereThereIsNoTagging)
{
    const Picture surface = shoot(scan(), request);
    request.wall.acquired = true;
    const Picture acquired = shoot(scan(), request);
    EXPECT_GT(differing(surface, acquired, 0), 0.1) << "made another way";
    EXPECT_LT(differing(surface, acquired, 40), 0.1);
}

TEST_F(AcquiredWall, ShowsFluidThatTheCleansedSurfaceLooksThrough)
{
    constexpr double kAhead_mm = 12;
    const SnapshotResult eye = place();
    const Picture before = shoot(scan(), request);
    fillAhead(eye.pose, kAhead_mm);
    EXPECT_EQ(differing(before, shoot(scan(colon, "filled"), request), 0), 0) << "the surface knows nothing of it";
    request.wall.acquired = true;
    for (const WallColors colors : {WallColors::mucosa, WallColors::bone}) {
        request.wall.colors = colors;
        const PreparedScan filled = scan(colon, "filled");
        const Picture acquired = shoot(filled, request);
        // The lamp's formula, for a level seen straight on at this distance.
        const double reach_mm = lampReachAt_mm(filled.frames(), eye.station_mm);
        const double light = std::sqrt(1.12 / (1 + kAhead_mm * kAhead_mm / (reach_mm * reach_mm)));
        const auto color = wallColor(colors);
        EXPECT_NEAR(acquired.at(150, 150).red, std::min(255.0, 255 * color[0] * light), 20);
        EXPECT_NEAR(acquired.at(150, 150).blue, std::min(255.0, 255 * color[2] * light), 20);
    }
}

TEST_F(AcquiredWall, IsMetByARayWhereThePictureShowsIt)
{
    constexpr double kAhead_mm = 12, kReach_mm = 500;
    const Pose eye = place().pose;
    fillAhead(eye, kAhead_mm);
    const PreparedScan filled = scan(colon, "filled");
    const Lumen lumen = filled.lumen();
    const auto alongRay = [&](Vector3 way) {
        return distanceToAcquiredWall_mm(filled.volume(), filled.gasEnds_hu(), lumen, eye.eye_mm, way, kReach_mm)
            .value_or(0);
    };
    const double voxel_mm = lumen.voxel_mm();
    EXPECT_NEAR(alongRay(eye.forward), kAhead_mm, voxel_mm);
    EXPECT_GT(distanceToWall_mm(lumen, eye.eye_mm, eye.forward, kReach_mm).value_or(0), kAhead_mm + 2 * voxel_mm);
    const double to_side_mm = distanceToWall_mm(lumen, eye.eye_mm, eye.right(), kReach_mm).value_or(0);
    EXPECT_NEAR(alongRay(eye.right()), to_side_mm, voxel_mm) << "where there is no fluid, the wall";
    fillAhead(eye, -20);
    EXPECT_EQ(distanceToAcquiredWall_mm(scan(colon, "under").volume(), filled.gasEnds_hu(), lumen, eye.eye_mm,
                                        eye.forward, kReach_mm),
              std::nullopt)
        << "from under fluid nothing is seen";
}

/// segment.wall_hu, as the step that made the surface had it.
TEST_F(AcquiredWall, StandsWhereTheScansOptionsHadIt)
{
    constexpr double kReach_mm = 500;
    const Pose eye = place().pose;
    request.wall.acquired = true;
    const Picture usual = shoot(scan(), request);
    const auto toWall_mm = [&](const PreparedScan& of) {
        return distanceToAcquiredWall_mm(of.volume(), of.gasEnds_hu(), of.lumen(), eye.eye_mm, eye.right(), kReach_mm)
            .value_or(0);
    };
    for (const double wall_hu : {-480.0, -900.0}) {
        const std::string name = std::to_string(int(wall_hu));
        colon.write(folder / name);
        scan_files::writeDescription(folder / name,
                                     {.steps = {{.step = "segment", .parameters = {{"segment.wall_hu", wall_hu}}}}});
        const PreparedScan of = PreparedScan::open(folder / name);
        EXPECT_EQ(of.gasEnds_hu(), wall_hu);
        const bool same = wall_hu == scan().gasEnds_hu();
        EXPECT_EQ(differing(usual, shoot(of, request), 0) == 0, same) << name;
        EXPECT_EQ(toWall_mm(of) < toWall_mm(scan()) - 0.2, !same) << "gas ends earlier in the blur of the wall";
    }
}

TEST_F(AcquiredWall, SaysWhereFluidFillsTheView)
{
    request.width = request.height = 600;
    const SnapshotResult eye = place();
    const auto orange = [&](const char* folder) {
        return findColor(shoot(scan(colon, folder), request), kWarningColor, {0, 0, 600, 280}, 40).count;
    };
    request.wall.acquired = true;
    fillAhead(eye.pose, 12);  // between it and the eye the wall is seen
    const Lens lens{request.view_angle_deg, 600, 600};
    const PreparedScan in_part = scan(colon, "in part");
    const double share = standingShare(in_part.volume(), in_part.gasEnds_hu(), in_part.lumen(), eye.pose, lens);
    EXPECT_GT(share, 0.05);
    EXPECT_LT(share, 0.9);
    EXPECT_EQ(orange("in part"), 0);
    fillAhead(eye.pose, 2);
    EXPECT_GT(orange("before the eye"), 30) << "a picture of nothing says so";
    request.wall.acquired = false;
    EXPECT_EQ(orange("before the eye"), 0);
}

TEST_F(AcquiredWall, SaysWhereTheEyeIsUnderFluid)
{
    const auto orange = [](const Picture& picture) {
        return findColor(picture, kWarningColor, {0, 0, 600, 280}, 40).count;
    };
    request.width = request.height = 600;
    const SnapshotResult eye = place();
    request.wall.acquired = true;
    EXPECT_EQ(orange(shoot(scan(), request)), 0);
    fillAhead(eye.pose, -20);
    const Picture nothing = shoot(scan(colon, "filled"), request);
    EXPECT_GT(orange(nothing), 30);
    EXPECT_EQ(nothing.at(300, 360).red, 0);
    request.wall.acquired = false;
    EXPECT_EQ(orange(shoot(scan(colon, "filled"), request)), 0);
}

}  // namespace
}  // namespace vicon::viewer
