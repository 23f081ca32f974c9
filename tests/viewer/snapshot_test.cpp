#include "vicon/viewer/scene/snapshot.h"

#include <gmock/gmock.h>

#include "snapshot_fixture.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace vicon::viewer {
namespace {

using namespace test;

struct Snapshots : Shooting<ColonFixture> {};
struct SnapshotsOf : Shooting<test::ScanFixture>, testing::WithParamInterface<int> {};

// The polyp lies on the patient's left, towards the feet from the middle, however the voxels are stored.
TEST_P(SnapshotsOf, ShowAMarkerOnThePatientsLeftOnTheRight)
{
    const test::TestColon stored(test::storages()[std::size_t(GetParam())]);
    ASSERT_GT(stored.polyp_mm.x, 30);
    const PreparedScan turned = scan(stored, "turned");
    SnapshotRequest request;
    request.markers = {markerAt(stored.polyp_mm, MarkerColor::red, "")};
    request.look_at_mm = stored.polyp_mm;
    request.width = 802;
    request.height = 602;
    const Rgb red = colorOf(MarkerColor::red);

    request.view = SnapshotView::slices;
    const Picture slices = shoot(turned, request);
    const Found axial = findColor(slices, red, {0, 0, 400, 300});
    const Found coronal = findColor(slices, red, {402, 0, 400, 300});
    const Found sagittal = findColor(slices, red, {0, 302, 400, 300});
    for (const Found& found : {axial, coronal, sagittal})
        ASSERT_GT(found.count, 20);
    EXPECT_GT(axial.x, 200 + 40);
    EXPECT_GT(coronal.x, 402 + 200 + 30);
    EXPECT_GT(coronal.y, 150);  // below the middle: towards the feet
    EXPECT_GT(axial.y, 150);    // behind the middle
    EXPECT_GT(sagittal.x, 200);
    EXPECT_GT(sagittal.y, 302 + 150);

    request.view = SnapshotView::overview;
    const Found overview = findColor(shoot(turned, request), red, {0, 0, 802, 602});
    ASSERT_GT(overview.count, 20);
    EXPECT_GT(overview.x, 401 + 60);
}

INSTANTIATE_TEST_SUITE_P(Storages, SnapshotsOf, testing::Range(0, int(test::storages().size())), [](const auto& info) {
    std::string name = test::storages()[std::size_t(info.param)].name;
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
});

TEST_F(Snapshots, ShowTheSameBodyTheSameWayHoweverItIsStored)
{
    SnapshotRequest request;
    request.look_at_mm = colon.polyp_mm;
    request.width = 602;
    request.height = 602;
    const test::TestColon other(test::storages()[3]);
    const PreparedScan straight = scan(), turned = scan(other, "turned");
    for (const auto view : {SnapshotView::slices, SnapshotView::overview, SnapshotView::endo}) {
        request.view = view;
        EXPECT_LT(differing(shoot(straight, request), shoot(turned, request), 50), 0.02) << int(view);
    }
}

TEST_F(Snapshots, OfAMarkerLookAtItFromWithinTheLumen)
{
    SnapshotRequest request;
    request.markers = {markerAt(colon.polyp_mm, MarkerColor::green, "")};
    request.look_at_mm = colon.polyp_mm;
    request.width = 500;
    request.height = 400;
    SnapshotResult result;
    const Picture picture = shoot(scan(), request, &result);
    EXPECT_TRUE(result.sees_target);
    EXPECT_GE(result.clearance_mm, 2);
    EXPECT_NEAR(result.station_mm, colon.polyp_station_mm, 6);
    const Found ring = findColor(picture, colorOf(MarkerColor::green), {0, 0, 500, 400});
    ASSERT_GT(ring.count, 50);
    EXPECT_NEAR(ring.x, 250, 2);
    EXPECT_NEAR(ring.y, 200, 2);
    // The ring leaves the polyp free: its middle is bright wall.
    const Rgb middle = picture.at(250, 200);
    EXPECT_GT(middle.red, 120);
    EXPECT_GT(middle.red, middle.blue);
}

TEST_F(Snapshots, AWideOverviewShowsTheColonBesideItsCaptionAndLargerSo)
{
    const PreparedScan of = scan();
    const double length_mm = of.skeleton().length_mm();
    SnapshotRequest request;
    request.view = SnapshotView::overview;
    request.height = 300;
    request.markers = {markerAt(of.skeleton().at(length_mm / 4).position_mm, MarkerColor::red, ""),
                       markerAt(of.skeleton().at(length_mm * 3 / 4).position_mm, MarkerColor::green, "")};
    const auto apart = [&](int width) {
        request.width = width;
        const Picture picture = shoot(of, request);
        const Area all{0, 0, double(width), double(request.height)};
        const Found red = findColor(picture, colorOf(MarkerColor::red), all);
        const Found green = findColor(picture, colorOf(MarkerColor::green), all);
        EXPECT_GT(red.count, 10);
        EXPECT_GT(green.count, 10);
        return std::hypot(red.x - green.x, red.y - green.y);
    };
    EXPECT_GT(apart(2 * request.height), 1.15 * apart(request.height));
}

TEST_F(Snapshots, AreTheSameBytesEachTime)
{
    const PreparedScan of = scan();
    for (const auto view : {SnapshotView::endo, SnapshotView::slices, SnapshotView::overview}) {
        SnapshotRequest request;
        request.view = view;
        request.station_mm = 120;
        request.width = request.height = 300;
        renderSnapshot(of, request, folder / "a.png");
        renderSnapshot(of, request, folder / "b.png");
        EXPECT_EQ(sha256OfFile(folder / "a.png"), sha256OfFile(folder / "b.png"));
    }
}

TEST_F(Snapshots, WithAmbientOcclusionShadeWhatIsBesideAPolypAndLeaveItReadable)
{
    SnapshotRequest request;
    request.look_at_mm = colon.polyp_mm;
    request.width = request.height = 300;
    const PreparedScan of = scan();
    request.wall.ambient_occlusion = false;
    const Picture plain = shoot(of, request);
    request.wall.ambient_occlusion = true;
    const Picture shaded = shoot(of, request);
    int same = 0, darker = 0, too_dark = 0, brighter = 0, count = 0;
    for (int y = 60; y < 240; ++y)  // between caption and indicator
        for (int x = 60; x < 240; ++x) {
            const int before = plain.at(x, y).red, after = shaded.at(x, y).red;
            ++count;
            brighter += after > before + 1 ? 1 : 0;
            same += after > 0.95 * before ? 1 : 0;
            darker += after < 0.85 * before ? 1 : 0;
            too_dark += after < 0.33 * before - 2 ? 1 : 0;
        }
    EXPECT_EQ(brighter, 0);
    EXPECT_EQ(too_dark, 0);
    EXPECT_GT(darker, count / 50);
    EXPECT_GT(same, count / 4);
    EXPECT_GT(shaded.at(150, 150).red, 0.7 * plain.at(150, 150).red);  // the polyp's top
}

TEST_F(Snapshots, RefuseWhatCannotBeDrawn)
{
    const PreparedScan of = scan();
    const auto refused = [&](auto change) {
        SnapshotRequest request;
        change(request);
        try {
            renderSnapshot(of, request, folder / "none.png");
        } catch (const Error& e) {
            return e.code() == ErrorCode::wrong_use && !std::filesystem::exists(folder / "none.png");
        }
        return false;
    };
    EXPECT_TRUE(refused([](SnapshotRequest& r) { r.width = 20; }));
    EXPECT_TRUE(refused([](SnapshotRequest& r) { r.height = 100000; }));
    EXPECT_TRUE(refused([](SnapshotRequest& r) { r.view_angle_deg = 180; }));
    EXPECT_TRUE(refused([](SnapshotRequest& r) { r.window = "none such"; }));
}

TEST_F(Snapshots, AMissingFileIsNamed)
{
    colon.write(folder / "scan");
    for (const char* name : {"volume.mha", "inside.mha", "skeleton.vtp", "wall_distance.mha", "cells.vtp"}) {
        const auto file = folder / "scan" / name, aside = folder / "aside";
        std::filesystem::rename(file, aside);
        try {
            PreparedScan::open(folder / "scan");
            ADD_FAILURE() << name;
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), ErrorCode::not_ready);
            EXPECT_THAT(e.subject(), testing::HasSubstr(name));
        }
        std::filesystem::rename(aside, file);
    }
    EXPECT_THROW(PreparedScan::open(folder / "nowhere"), Error);
}

}  // namespace
}  // namespace vicon::viewer
