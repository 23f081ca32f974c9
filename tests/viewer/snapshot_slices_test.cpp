// Slices in pictures, and the words on them.
#include "snapshot_fixture.h"
#include "vicon/scan_files/volume_file.h"
#include "vicon/viewer/model/slice_image.h"
#include "vicon/viewer/scene/canvas.h"
#include "vicon/viewer/scene/reading_pictures.h"
#include "vicon/viewer/scene/slice_pictures.h"

namespace vicon::viewer {
namespace {

using namespace test;

struct SliceSnapshots : Shooting<ColonFixture> {};

TEST_F(SliceSnapshots, ALongLineInANarrowSliceIsNotWrittenSmallerThanItMustBe)
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

TEST_F(SliceSnapshots, OnAScreenOfTwiceThePixelsTextIsTwiceAsHigh)
{
    const PreparedScan of = scan();
    SliceRequest slice;
    SnapshotRequest overview;
    overview.view = SnapshotView::overview;
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

TEST_F(SliceSnapshots, CarryNameAndWarningOfLossyPixels)
{
    const PreparedScan of = scan();
    SnapshotRequest request;
    request.view = SnapshotView::slices;
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

TEST_F(SliceSnapshots, ASliceOfAPatientOfWhomNothingIsKnownSaysNoDistance)
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

TEST_F(SliceSnapshots, SlicesShowWhatWasAcquiredOrItWithoutTaggingAndSayWhich)
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
    const Picture plain = drawn(acquired, false);  // one kind only, and no word
    EXPECT_GT(differing(drawn(cleansed, false), plain, 1), 0.001) << "as acquired";
    const double said = differing(drawn(acquired, true), plain, 1);
    EXPECT_GT(said, 0.001) << "asked for what there is not: as acquired";
    EXPECT_LT(said, 0.01) << "but for that word the same";
}

TEST_F(SliceSnapshots, OfSlicesThatAreScrolledThroughAreThoseOfSingleSlices)
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

}  // namespace
}  // namespace vicon::viewer
