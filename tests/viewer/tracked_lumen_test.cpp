#include "vicon/viewer/model/tracked_lumen.h"

#include <gtest/gtest.h>

#include "test_colon.h"
#include "vicon/viewer/model/slice_image.h"

namespace vicon::viewer {
namespace {

constexpr double kSlice_mm = 1;

TEST(TrackedLumen, EachSliceIsTheNextOneOrAsFarWithinIt)
{
    const test::TestColon colon;
    const PathFrames path(colon.skeleton);
    for (const Vector3 across : {Vector3{0, 0, 1}, Vector3{0, 1, 0}, Vector3{1, 0, 0}}) {
        int slices = 0, within = 0;
        double station = 0;
        while (station < path.length_mm()) {
            const double next = stationSlicesOn(path, station, across, kSlice_mm, 1);
            ASSERT_GT(next, station);
            const double moved = std::abs(dot(path.at(next).position_mm - path.at(station).position_mm, across));
            EXPECT_LE(next - station, 4 + 1e-9) << "nothing is leapt over";
            EXPECT_LE(moved, kSlice_mm + 0.26);
            const bool whole = moved >= kSlice_mm;
            EXPECT_TRUE(whole || next - station > 3.9 || next == path.length_mm()) << station;
            whole ? ++slices : ++within;
            station = next;
        }
        EXPECT_GT(slices, 50);
        EXPECT_GT(within, 10);
    }
}

TEST(TrackedLumen, GoesBackTheSameWayAndStopsAtTheEnds)
{
    const test::TestColon colon;
    const PathFrames path(colon.skeleton);
    const Vector3 up{0, 0, 1};
    EXPECT_EQ(stationSlicesOn(path, 0, up, kSlice_mm, -3), 0);
    EXPECT_EQ(stationSlicesOn(path, path.length_mm() - 0.1, up, kSlice_mm, 5), path.length_mm());
    const double there = stationSlicesOn(path, 100, up, kSlice_mm, 10);
    EXPECT_NEAR(stationSlicesOn(path, there, up, kSlice_mm, -10), 100, 5);
    EXPECT_EQ(stationSlicesOn(path, 100, up, kSlice_mm, 0), 100);
}

TEST(TrackedLumen, TheSliceAcrossTheLumenIsSeenAsTheEyeLooksAndIsRolled)
{
    const test::TestColon colon;
    const PathFrames way(colon.skeleton);
    for (const double station : {10.0, 150.0, 333.0, way.length_mm() - 20})
        for (const double roll : {0.0, 0.7, -2.5})
            for (const int sense : {1, -1}) {
                const PathFrame frame = way.at(station);
                const Vector3 side = cross(frame.forward, frame.up);
                const Vector3 up = frame.up * std::cos(roll) + side * std::sin(roll);
                // The eye looks 40 degrees to the side and up, and is a little off the middle.
                const Vector3 aside = side * std::cos(roll) - frame.up * std::sin(roll);
                const Vector3 ahead = frame.forward * sense;
                const Pose eye{frame.position_mm + side * 0.4, normalized(ahead + aside * 0.6 + up * 0.6),
                               normalized(up - ahead * 0.4)};
                const SliceAxes axes = axesAcross(way, frame.position_mm, eye);
                EXPECT_GT(dot(cross(axes.right, axes.down), ahead), 0.999) << station;
                EXPECT_GT(dot(axes.down, up * -1), 0.98) << station << " what is above stays above";
                EXPECT_GT(dot(axes.right, eye.right()), 0.5) << station << " and the right on the right";
                EXPECT_NEAR(dot(axes.right, axes.down), 0, 1e-9);
            }
}

/// Carried along a way without bends, the eye's roll is kept.
TEST(TrackedLumen, TheEyesRollIsCarriedToAnotherPlace)
{
    Skeleton line;
    line.pieces = {{false, {{{0, 0, 0}, 0, 9}, {{0, 0, 100}, 100, 9}}}};
    const PathFrames way(line);
    const SliceAxes axes = axesAcross(way, {3, 1, 80}, {{1, 0, 20}, {0, 0.6, -0.8}, {1, 0, 0}});
    EXPECT_NEAR(axes.down.x, -1, 1e-6);
    EXPECT_NEAR(cross(axes.right, axes.down).z, -1, 1e-6) << "seen towards the feet, as the eye looks";
}

TEST(TrackedLumen, TheRimIsThatOfTheLoopAroundThePlaceAlone)
{
    for (const test::Storage& storage : {test::storages().front(), test::storages().back()}) {
        const test::TestColon colon(storage);
        const PathFrames path(colon.skeleton);
        // The left side goes up and the right side down: an axial slice cuts both.
        const double station = path.length_mm() / 5;
        const Point3 here = path.at(station).position_mm;
        const PlaneView view = sliceThrough(colon.volume.grid, SlicePlane::axial, here, 400, 300);
        const InsideView inside = colon.inside;
        const auto rim = lumenRim(inside, view, here);
        const double radius_mm = path.at(station).radius_mm;
        int count = 0, lumen_elsewhere = 0, differing = 0;
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const Point3 p = view.pointAt({x + 0.5, y + 0.5});
                const bool in = inside.valueOr(inside.grid.indexAt(p), 0) != 0;
                const std::size_t at = std::size_t(y * view.width + x);
                differing += rim[at] > 0.5F && !in;
                lumen_elsewhere += in && distance(p, here) > 4 * radius_mm;
                if (rim[at] <= 0.5F)
                    continue;
                ++count;
                EXPECT_LT(distance(p, here), 4 * radius_mm) << storage.name << ": another loop";
            }
        EXPECT_GT(count, int(radius_mm / view.mm_per_pixel)) << storage.name;
        EXPECT_LT(differing, 2 * count / 3) << storage.name << ": the line lies on the edge, half of it beyond";
        EXPECT_GT(lumen_elsewhere, 100) << storage.name << ": there is another loop in the slice";
    }
}

/// In a ball the slice's lumen is a circle, however the slice lies in the voxels.
TEST(TrackedLumen, TheRimOfABallIsACircleInAnySlice)
{
    constexpr double kRadius_mm = 12;
    Grid grid;
    grid.size = {40, 40, 40};
    InsideVolume inside(grid, 0);
    const Point3 middle{19.3, 20.1, 19.7};
    for (std::size_t n = 0; n < inside.voxels.size(); ++n) {
        const Point3 p = grid.pointAt(grid.indexOf(n));
        inside.voxels[n] = distance(p, middle) < kRadius_mm;
    }
    for (const Vector3 forward : {Vector3{0, 0, 1}, normalized(Vector3{1, 2, 3}), normalized(Vector3{5, 1, 4})}) {
        const Vector3 right = normalized(cross(Vector3{0.3, 1, 0}, forward));
        const SliceAxes axes{right, cross(forward, right)};
        const PlaneView view = sliceThrough(grid, axes, middle, 320, 320, 32);
        const auto rim = lumenRim(inside, view, middle);
        for (std::size_t n = 0; n < rim.size(); ++n) {
            const Pixel at{double(n % 320) + 0.5, double(n / 320) + 0.5};
            EXPECT_TRUE(rim[n] == 0 || std::abs(distance(view.pointAt(at), middle) - kRadius_mm) < 0.6)
                << "half a voxel";
        }
        // Smooth: all around the line is as wide and as dense, and there are pixels that it covers in part.
        int partly = 0;
        for (int degrees = 0; degrees < 360; ++degrees) {
            double across_px = 0;
            for (double off_px = -8; off_px <= 8; off_px += 0.5) {
                const double r = kRadius_mm / view.mm_per_pixel + off_px, angle = radians(degrees);
                const int x = int(160 + r * std::cos(angle)), y = int(160 + r * std::sin(angle));
                const float covers = rim[std::size_t(y) * 320 + std::size_t(x)];
                across_px += 0.5 * covers;
                partly += covers > 0.05F && covers < 0.95F;
            }
            EXPECT_NEAR(across_px, 1.5, 1.1) << degrees;
        }
        EXPECT_GT(partly, 360);
    }
}

TEST(TrackedLumen, ThereIsNoRimWhereThereIsNoLumen)
{
    const test::TestColon colon;
    const Point3 away = colon.volume.grid.pointAt(Index3{0, 0, 0});
    const PlaneView view = sliceThrough(colon.volume.grid, SlicePlane::axial, away, 60, 60);
    for (const float pixel : lumenRim(colon.inside, view, away))
        EXPECT_EQ(pixel, 0);
}

}  // namespace
}  // namespace vicon::viewer
