#include "vicon/viewer/scene/flight.h"

#include <gtest/gtest.h>

#include "render_checks.h"
#include "scan_fixture.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/viewer/model/flight_plan.h"
#include "vicon/viewer/scene/id_scene.h"
#include "vicon/viewer/scene/offscreen.h"
#include "vicon/viewer/scene/sight_ahead.h"

namespace vicon::viewer {
namespace {

struct Flights : test::ColonFixture {};

TEST_F(Flights, ShowNothingButWallAndEachTriangleWhereTheModelPutsIt)
{
    const PreparedScan of = scan();
    IdScene ids(of.cells());
    Offscreen offscreen(ids.renderer());
    constexpr int kSide = 240;
    const Lens lens{90, kSide, kSide};
    for (const ViewPose& view : planFlight(of.frames(), of.lumen(), 25, Heading::caecum)) {
        ids.lookFrom(view.pose, lens.view_angle_deg);
        const Picture picture = offscreen.render(kSide, kSide);
        std::size_t empty = 0, misplaced = 0;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const Rgb c = picture.at(x, y);
                const std::size_t id = c.red | std::size_t(c.green) << 8 | std::size_t(c.blue) << 16;
                if (id == 0) {
                    ++empty;
                    continue;
                }
                // The pixel lies in the box around its triangle's three corners.
                double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
                bool before = true;
                for (std::size_t corner = 0; corner < 3; ++corner) {
                    const Projected p =
                        project(view.pose, lens, colon.cells.point(colon.cells.triangles[3 * (id - 1) + corner]));
                    before = before && p.depth_mm > 0.3;
                    left = std::min(left, p.at.x);
                    right = std::max(right, p.at.x);
                    top = std::min(top, p.at.y);
                    bottom = std::max(bottom, p.at.y);
                }
                const double px = x + 0.5, py = y + 0.5;
                misplaced += before && (px < left - 0.6 || px > right + 0.6 || py < top - 0.6 || py > bottom + 0.6);
            }
        EXPECT_EQ(empty, 0U) << view.station_mm;
        EXPECT_EQ(misplaced, 0U) << view.station_mm;
    }
}

TEST_F(Flights, CulledPicturesAreIdenticalToPicturesOfEverything)
{
    test::expectCulledPicturesIdentical(scan(), 25, 1);
}

TEST_F(Flights, CulledPicturesWithAmbientOcclusionAreIdenticalToPicturesOfEverything)
{
    test::expectCulledPicturesIdentical(scan(), 25, 1, 200, true);
}

TEST_F(Flights, ChoosingAheadGivesWhatChoosingAtOnceGives)
{
    const PreparedScan of = scan();
    const CellVisibility visibility(of);
    SightAhead ahead(visibility);
    const Lens lens{90, 200, 160}, wide{110, 200, 160};
    const auto poses = planFlight(of.frames(), of.lumen(), 40, Heading::caecum);
    ASSERT_GT(poses.size(), 4U);
    for (std::size_t n = 0; n < poses.size(); ++n) {
        const Pose here = poses[n].pose, next = poses[(n + 1) % poses.size()].pose;
        const VisibleParts wanted = visibility.visibleFrom(here, lens), found = ahead.visibleFrom(here, lens);
        EXPECT_EQ(found.everything, wanted.everything);
        EXPECT_EQ(found.segments, wanted.segments);
        EXPECT_EQ(found.patches, wanted.patches);
        ahead.prepare(next, n % 3 == 0 ? wide : lens);  // now and then for another lens than is asked then
        ahead.prepare(n % 4 == 1 ? here : next, lens);  // or another place
    }
}

TEST_F(Flights, ReportPosesFramesAndCoverage)
{
    const PreparedScan of = scan();
    NoProgress progress;
    FlightRequest request;
    request.step_mm = 12;
    request.width = request.height = 240;
    request.out = folder / "flight";
    const FlightReport one_way = fly(of, request, progress);
    ASSERT_GT(one_way.frames.size(), 20U);
    EXPECT_TRUE(std::filesystem::exists(folder / "flight" / "frame-00001.png"));
    EXPECT_NEAR(one_way.frames.front().station_mm, 0, 3);
    EXPECT_NEAR(one_way.frames.back().station_mm, one_way.length_mm, 3);
    EXPECT_EQ(one_way.triangles, colon.cells.triangleCount());
    for (const FlightFrame& frame : one_way.frames) {
        EXPECT_GE(frame.clearance_mm, 2);
        EXPECT_LE(frame.triangles_seen, frame.triangles_drawn);
        EXPECT_GT(frame.triangles_seen, 100U);
    }
    EXPECT_LT(one_way.average_triangles, 0.6 * double(one_way.triangles));
    EXPECT_GT(one_way.coverage, 0.6);
    EXPECT_LT(one_way.coverage, 1.0);
    EXPECT_GT(one_way.reviewed, 0.3) << "steeply enough";
    EXPECT_LT(one_way.reviewed, one_way.coverage);

    const auto json = nlohmann::json::parse(readFile(folder / "flight" / "flight.json"));
    EXPECT_EQ(json.at("frames").size(), one_way.frames.size());
    EXPECT_NEAR(json.at("coverage").get<double>(), one_way.coverage, 1e-9);

    EXPECT_NEAR(one_way.seen_mm2, one_way.coverage * one_way.whole_mm2, 1e-6 * one_way.whole_mm2);
    double unseen = 0;
    for (const UnseenPatch& patch : one_way.unseen)
        unseen += patch.area_mm2;
    ASSERT_FALSE(one_way.unseen.empty());
    EXPECT_LE(unseen, one_way.whole_mm2 - one_way.seen_mm2 + 1e-3 * unseen);
    EXPECT_GT(unseen, 0.5 * (one_way.whole_mm2 - one_way.seen_mm2));  // most of it hides behind folds, not in specks
    ASSERT_EQ(json.at("unseen").size(), one_way.unseen.size());
    EXPECT_NEAR(json.at("unseen")[0].at("area_mm2").get<double>(), one_way.unseen[0].area_mm2, 1e-9);

    request.direction = FlightDirection::both;
    request.write_frames = false;
    const FlightReport both = fly(of, request, progress);
    EXPECT_GT(both.coverage, one_way.coverage);
    EXPECT_EQ(both.frames.size(), 2 * one_way.frames.size());
}

TEST_F(Flights, StopWhenNobodyWantsThemAnyMore)
{
    struct Impatient : Progress {
        int frames = 0;
        void report(double, std::string_view) override { ++frames; }
        bool cancelled() const override { return frames >= 2; }
    } progress;
    FlightRequest request;
    request.width = request.height = 200;
    try {
        fly(scan(), request, progress);
        ADD_FAILURE();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::cancelled);
    }
    EXPECT_EQ(progress.frames, 2);
}

}  // namespace
}  // namespace vicon::viewer
