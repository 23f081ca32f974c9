#include "vicon/viewer/scene/snapshot.h"

#include <gmock/gmock.h>

#include "scan_fixture.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/picture/png_file.h"
#include "vicon/scan_files/volume_file.h"
#include "vicon/viewer/model/annotate.h"
#include "vicon/viewer/model/slice_image.h"
#include "vicon/viewer/scene/canvas.h"
#include "vicon/viewer/scene/reading_pictures.h"
#include "vicon/viewer/scene/slice_pictures.h"

namespace vicon::viewer {
namespace {

Picture readPng(const std::filesystem::path& file)
{
    const picture::Picture read = picture::readPng(file);
    Picture picture(read.width, read.height);
    picture.rgb = read.pixels;
    return picture;
}

struct Found {
    int count = 0;
    double x = 0, y = 0;  // middle of their pixels
};

// Pixels of this colour within an area.
Found findColor(const Picture& picture, Rgb color, const Area& area, int tolerance = 0)
{
    const auto near = [&](Rgb c) {
        return std::abs(c.red - color.red) <= tolerance && std::abs(c.green - color.green) <= tolerance &&
               std::abs(c.blue - color.blue) <= tolerance;
    };
    Found found;
    for (int y = int(area.y); y < int(area.bottom()); ++y)
        for (int x = int(area.x); x < int(area.right()); ++x)
            if (near(picture.at(x, y))) {
                ++found.count;
                found.x += x;
                found.y += y;
            }
    found.x /= std::max(1, found.count);
    found.y /= std::max(1, found.count);
    return found;
}

double differing(const Picture& a, const Picture& b, int tolerance)
{
    std::size_t count = 0;
    for (std::size_t n = 0; n < a.rgb.size(); ++n)
        count += std::abs(int(a.rgb[n]) - int(b.rgb[n])) > tolerance;
    return double(count) / double(a.rgb.size());
}

Marker markerAt(Point3 p, MarkerColor color, const std::string& id)
{
    Marker marker;
    marker.id = id;
    marker.position_mm = p;
    marker.color = color;
    return marker;
}

template <class Fixture>
struct Shooting : Fixture {
    Picture shoot(const PreparedScan& of, const SnapshotRequest& request, SnapshotResult* result = nullptr) const
    {
        const auto file = this->folder / "picture.png";
        const SnapshotResult r = renderSnapshot(of, request, file);
        if (result)
            *result = r;
        return readPng(file);
    }
};

struct Snapshots : Shooting<test::ColonFixture> {};
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

    request.view = SnapshotRequest::View::slices;
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

    request.view = SnapshotRequest::View::overview;
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
    for (const auto view :
         {SnapshotRequest::View::slices, SnapshotRequest::View::overview, SnapshotRequest::View::endo}) {
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
    request.view = SnapshotRequest::View::overview;
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

TEST_F(Snapshots, ALongLineInANarrowSliceIsNotWrittenSmallerThanItMustBe)
{
    const PreparedScan of = scan();
    SliceRequest slice;
    slice.view = sliceThrough(of.volume().grid, SlicePlane::axial, colon.polyp_mm, 260, 260);
    slice.window = {"dark", 100, 10000};
    slice.caption.patient_name = "Katzenellenbogen^Maximiliane";
    int least = 260, most = 0;
    const Picture picture = slicePicture(of.volume(), slice);
    for (int x = 0; x < 260; ++x)
        if (findColor(picture, kTextColor, {double(x), 16, 1, 16}, 60).count > 0) {
            least = std::min(least, x);
            most = std::max(most, x);
        }
    EXPECT_GT(most - least, 0.55 * 260) << "it may pass below the letter in the middle";
}

TEST_F(Snapshots, OnAScreenOfTwiceThePixelsTextIsTwiceAsHigh)
{
    const PreparedScan of = scan();
    SliceRequest slice;
    SnapshotRequest overview;
    overview.view = SnapshotRequest::View::overview;
    overview.caption.patient_name = slice.caption.patient_name = "Phantom^Anna";
    const auto written = [&](int scale) {
        slice.view = sliceThrough(of.volume().grid, SlicePlane::axial, colon.polyp_mm, 300 * scale, 300 * scale);
        slice.window = {"dark", 100, 10000};
        overview.width = overview.height = 300 * scale;
        slice.pixel_ratio = overview.pixel_ratio = scale;
        const Area corner{0, 0, 140.0 * scale, 60.0 * scale};
        return std::pair(findColor(slicePicture(of.volume(), slice), kTextColor, corner, 60).count,
                         findColor(shoot(of, overview), kTextColor, corner, 60).count);
    };
    const auto once = written(1), twice = written(2);
    EXPECT_GT(twice.first, 3 * once.first);
    EXPECT_GT(twice.second, 3 * once.second);
}

TEST_F(Snapshots, AreTheSameBytesEachTime)
{
    const PreparedScan of = scan();
    for (const auto view :
         {SnapshotRequest::View::endo, SnapshotRequest::View::slices, SnapshotRequest::View::overview}) {
        SnapshotRequest request;
        request.view = view;
        request.station_mm = 120;
        request.width = request.height = 300;
        renderSnapshot(of, request, folder / "a.png");
        renderSnapshot(of, request, folder / "b.png");
        EXPECT_EQ(sha256OfFile(folder / "a.png"), sha256OfFile(folder / "b.png"));
    }
}

TEST_F(Snapshots, CarryNameAndWarningOfLossyPixels)
{
    const PreparedScan of = scan();
    SnapshotRequest request;
    request.view = SnapshotRequest::View::slices;
    request.width = request.height = 600;
    request.station_mm = 100;
    const Area caption{302, 302, 290, 200};
    const int plain = findColor(shoot(of, request), kTextColor, caption, 80).count;
    request.caption.patient_name = "Müller^Änne Annegret";  // longer than "name not given"
    const int named = findColor(shoot(of, request), kTextColor, caption, 80).count;
    EXPECT_GT(named, plain + 30);
    EXPECT_EQ(findColor(shoot(of, request), kWarningColor, caption, 30).count, 0);
    request.caption.lossy = true;
    EXPECT_GT(findColor(shoot(of, request), kWarningColor, caption, 30).count, 30);
}

TEST_F(Snapshots, ASliceOfAPatientOfWhomNothingIsKnownSaysNoDistance)
{
    const PreparedScan prepared = scan();
    SliceRequest request;
    request.view = sliceThrough(prepared.volume().grid, SlicePlane::axial, colon.polyp_mm, 400, 400);
    request.point_mm = colon.polyp_mm;
    request.window = {"dark", 100, 10000};
    // Under three lines: the place, that there is no name, and the window.
    const double line_px = 1.35 * 1.15 * textHeightFor(400, 400);
    EXPECT_EQ(
        findColor(slicePicture(prepared.volume(), request), kTextColor, {0, 3.4 * line_px, 180, 3 * line_px}, 60).count,
        0);
    request.caption.patient_id = "PH-1";
    request.caption.position = "supine";
    EXPECT_GT(
        findColor(slicePicture(prepared.volume(), request), kTextColor, {0, 3.4 * line_px, 180, 3 * line_px}, 60).count,
        0);
}

TEST_F(Snapshots, SlicesShowWhatWasAcquiredOrItWithoutTaggingAndSayWhich)
{
    const PreparedScan acquired = scan(colon, "acquired");
    colon.write(folder / "cleansed");
    HuVolume around(Grid{.size = {20, 20, 20}, .spacing_mm = colon.volume.grid.spacing_mm}, 200);
    around.grid.origin_mm = colon.polyp_mm - Vector3{10, 10, 10};
    scan_files::writeVolume(folder / "cleansed" / "cleansed.mha", around, scan_files::Packing::raw);
    const PreparedScan cleansed = PreparedScan::open(folder / "cleansed");
    SliceRequest request;
    request.view = sliceThrough(colon.volume.grid, SlicePlane::axial, colon.polyp_mm, 400, 400, 60);
    request.point_mm = colon.polyp_mm;
    request.window = {"test", 100, 200};
    EXPECT_EQ(acquired.cleansed(), nullptr);
    ASSERT_NE(cleansed.cleansed(), nullptr);
    const auto drawn = [&](const PreparedScan& of, bool clean) {
        request.cleansed = clean;
        return slicePicture(of.volume(), request, of.cleansed());
    };
    const Pixel aside = request.view.toPixel(colon.polyp_mm + Vector3{6, 6, 0});
    const auto greyAt = [&](const Picture& picture) {
        return int(picture.rgb[3 * (std::size_t(aside.y) * 400 + std::size_t(aside.x))]);
    };
    EXPECT_NEAR(greyAt(drawn(cleansed, true)), 127, 2) << "200 HU in the middle of the window";
    EXPECT_EQ(greyAt(drawn(cleansed, false)), greyAt(drawn(acquired, false)));
    EXPECT_EQ(differing(drawn(acquired, true), drawn(acquired, false), 1), 0) << "there is one kind only, and no word";
    const Picture one = drawn(cleansed, false), other = drawn(acquired, false);
    EXPECT_GT(differing(one, other, 1), 0.001) << "as acquired";
}

TEST_F(Snapshots, LookBelowTheWallInTheMiddleOnlyWhereAskedTo)
{
    SnapshotRequest request;
    request.look_at_mm = colon.polyp_mm;
    request.width = request.height = 300;
    const Picture surface = shoot(scan(), request);
    request.peel = "biopsy";
    request.peel_middle_only = true;
    const Picture peeled = shoot(scan(), request);
    EXPECT_NE(surface.at(150, 150), peeled.at(150, 150));
    int beyond = 0;
    for (int x = 0; x < 300; ++x)  // a row that has neither caption nor letters; the circle's radius is 90
        beyond += std::abs(x - 150) > 95 && surface.at(x, 120) != peeled.at(x, 120) ? 1 : 0;
    EXPECT_EQ(beyond, 0);
    request.peel = "no-such-preset";
    EXPECT_THROW(shoot(scan(), request), Error);
}

TEST_F(Snapshots, WithAmbientOcclusionShadeWhatIsBesideAPolypAndLeaveItReadable)
{
    SnapshotRequest request;
    request.look_at_mm = colon.polyp_mm;
    request.width = request.height = 300;
    const PreparedScan of = scan();
    request.ambient_occlusion = false;
    const Picture plain = shoot(of, request);
    request.ambient_occlusion = true;
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

TEST_F(Snapshots, OfSlicesThatAreScrolledThroughAreThoseOfSingleSlices)
{
    const auto of = std::make_shared<const PreparedScan>(scan());
    SlicePictures pictures;
    SliceRequest request;
    request.window = windowPreset("colon");
    for (const SlicePlane plane : {SlicePlane::sagittal, SlicePlane::coronal})
        for (const double x : {-40.0, -38.5, -37.0, -35.0, -33.0, 50.0, 49.0, 47.3, 20.0}) {  // scrolled, and jumps
            request.plane = plane;
            request.point_mm = {x, x / 2, 10};
            request.view = sliceThrough(of->volume().grid, plane, request.point_mm, 220, 200);
            EXPECT_EQ(differing(pictures.draw(of, request), slicePicture(of->volume(), request), 1), 0) << x;
            pictures.readAhead();
        }
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
    EXPECT_THROW(snapshotViewFrom("side"), Error);
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
