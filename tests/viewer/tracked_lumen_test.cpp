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
        int count = 0, lumen_elsewhere = 0;
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const Point3 p = view.pointAt({x + 0.5, y + 0.5});
                const bool in = inside.valueOr(inside.grid.indexAt(p), 0) != 0;
                lumen_elsewhere += in && distance(p, here) > 4 * radius_mm;
                if (!rim[std::size_t(y * view.width + x)])
                    continue;
                ++count;
                EXPECT_TRUE(in) << storage.name;
                EXPECT_LT(distance(p, here), 4 * radius_mm) << storage.name << ": another loop";
            }
        EXPECT_GT(count, int(radius_mm / view.mm_per_pixel)) << storage.name;
        EXPECT_GT(lumen_elsewhere, 100) << storage.name << ": there is another loop in the slice";
    }
}

TEST(TrackedLumen, ThereIsNoRimWhereThereIsNoLumen)
{
    const test::TestColon colon;
    const Point3 away = colon.volume.grid.pointAt(Index3{0, 0, 0});
    const PlaneView view = sliceThrough(colon.volume.grid, SlicePlane::axial, away, 60, 60);
    for (const std::uint8_t pixel : lumenRim(colon.inside, view, away))
        EXPECT_EQ(pixel, 0);
}

}  // namespace
}  // namespace vicon::viewer
