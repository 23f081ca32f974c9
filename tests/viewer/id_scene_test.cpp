#include "vicon/viewer/scene/id_scene.h"

#include "scan_fixture.h"
#include "vicon/viewer/scene/cell_visibility.h"
#include "vicon/viewer/scene/offscreen.h"
#include "vicon/viewer/scene/surface_scene.h"

namespace vicon::viewer {
namespace {

struct IdScenes : test::ColonFixture {};

// OpenGL numbers the triangles of each run that is drawn from 0.
TEST_F(IdScenes, TellTheSameTrianglesWhetherEverythingIsDrawnOrOnlyWhatIsInSight)
{
    constexpr int kSide = 200, kPlaces = 8;
    const PreparedScan of = scan();
    IdScene ids(of.cells());
    Offscreen offscreen(ids.renderer());
    const CellVisibility visibility(of);
    const PathFrames& frames = of.frames();
    for (int n = 1; n < kPlaces; ++n) {
        const double station_mm = frames.length_mm() * n / kPlaces;
        const Pose pose = lookAt(frames.at(station_mm).position_mm, frames.at(station_mm + 5).position_mm, {0, 0, 1});
        const VisibleParts seen = visibility.visibleFrom(pose, {90, kSide, kSide});
        EXPECT_FALSE(seen.everything);
        ids.lookFrom(pose, 90);
        ids.showSeen({.everything = true, .segments = {}, .patches = {}});
        const auto in_all = IdScene::trianglesIn(offscreen.render(kSide, kSide));
        ids.showSeen(seen);
        EXPECT_EQ(IdScene::trianglesIn(offscreen.render(kSide, kSide)), in_all) << station_mm << " mm";
        EXPECT_GT(in_all.size(), 100U);
    }
}

// The reading room sends all cells to the driver before one flies.
TEST_F(IdScenes, WhatIsSentAheadIsNeitherDrawnNorCounted)
{
    constexpr int kSide = 100;
    const PreparedScan of = scan();
    SurfaceScene scene(of.cells());
    Offscreen offscreen(scene.renderer());
    const VisibleParts one{.everything = false, .segments = {of.cells().segment.front()}, .patches = {}};
    const PathFrames& frames = of.frames();
    const double middle_mm = frames.length_mm() / 2;
    scene.lookFrom(lookAt(frames.at(middle_mm).position_mm, frames.at(middle_mm + 5).position_mm, {0, 0, 1}), 90);
    scene.showSeen(one);
    const std::size_t triangles = scene.trianglesShown();
    const auto before = offscreen.render(kSide, kSide).rgb;
    scene.sendAll();
    EXPECT_EQ(offscreen.render(kSide, kSide).rgb, before);
    EXPECT_EQ(scene.cellsShown(), 1U);
    EXPECT_EQ(scene.trianglesShown(), triangles);
    scene.showOnly({});
    EXPECT_EQ(scene.cellsShown(), scene.cellCount());
    EXPECT_NE(offscreen.render(kSide, kSide).rgb, before);
}

}  // namespace
}  // namespace vicon::viewer
