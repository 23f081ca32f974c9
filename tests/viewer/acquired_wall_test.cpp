// The wall as acquired: tagged fluid stands where it stood.
#include "snapshot_fixture.h"
#include "vicon/viewer/model/camera.h"
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
