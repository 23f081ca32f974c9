// Looks below the wall in pictures.
#include "snapshot_fixture.h"
#include "vicon/core/error.h"

namespace vicon::viewer {
namespace {

using namespace test;

struct PeeledSnapshots : Shooting<ColonFixture> {};

TEST_F(PeeledSnapshots, LookBelowTheWallInTheMiddleOnlyWhereAskedTo)
{
    SnapshotRequest request;
    request.look_at_mm = colon.polyp_mm;
    request.width = request.height = 300;
    const Picture surface = shoot(scan(), request);
    request.peel.preset = "biopsy";
    request.peel.middle_only = true;
    const Picture peeled = shoot(scan(), request);
    EXPECT_NE(surface.at(150, 150), peeled.at(150, 150));
    int beyond = 0;
    for (int x = 0; x < 300; ++x)  // a row that has neither caption nor letters; the circle's radius is 90
        beyond += std::abs(x - 150) > 95 && surface.at(x, 120) != peeled.at(x, 120) ? 1 : 0;
    EXPECT_EQ(beyond, 0);
    request.peel.preset = "no-such-preset";
    EXPECT_THROW(shoot(scan(), request), Error);
}

TEST_F(PeeledSnapshots, LayThePeeledPictureOverTheSurfaceOrPutItInItsPlace)
{
    SnapshotRequest request;
    request.look_at_mm = colon.polyp_mm;
    request.width = request.height = 300;
    request.captioned = false;
    const PreparedScan of = scan();
    const Picture surface = shoot(of, request);
    request.peel.preset = "biopsy";
    request.peel.options.offset_mm = 3;
    const Picture instead = shoot(of, request);
    request.peel.over_surface = true;
    const Picture over = shoot(of, request);
    int between = 0, count = 0;
    for (int y = 70; y < 230; ++y)
        for (int x = 100; x < 200; ++x) {
            const int a = surface.at(x, y).red, b = instead.at(x, y).red, mixed = over.at(x, y).red;
            // What has no opacity leaves the surface alone: it may stay brighter than the peeled picture on black.
            between += mixed >= std::min(a, b) - 2 && mixed <= a + b + 2 ? 1 : 0;
            ++count;
        }
    EXPECT_EQ(between, count);
    EXPECT_GT(differing(over, surface, 8), 0.1);
    EXPECT_GT(differing(over, instead, 8), 0.1);
    // Rays from before the surface begin in gas, which these colours do not show: the wall itself comes first.
    request.peel.over_surface = false;
    request.peel.options.offset_mm = -5;
    const Picture before = shoot(of, request);
    request.peel.options.offset_mm = 0;
    EXPECT_LT(differing(before, shoot(of, request), 24), 0.1);
    EXPECT_GT(differing(before, instead, 24), 0.1);
}

}  // namespace
}  // namespace vicon::viewer
