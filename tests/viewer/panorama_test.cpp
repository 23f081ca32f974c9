// Pictures of all of the wall: the unfolded cube, the band, the body that turns.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scan_fixture.h"
#include "vicon/core/error.h"
#include "vicon/picture/png_file.h"
#include "vicon/viewer/model/annotate.h"
#include "vicon/viewer/scene/band_picture.h"
#include "vicon/viewer/scene/cube_picture.h"
#include "vicon/viewer/scene/reading_pictures.h"
#include "vicon/viewer/scene/turned_picture.h"

namespace vicon::viewer {
namespace {

using Panorama = test::ColonFixture;

Picture readPicture(const std::filesystem::path& file)
{
    const picture::Picture read = picture::readPng(file);
    Picture picture(read.width, read.height);
    picture.rgb = read.pixels;
    return picture;
}

int apart(Rgb a, Rgb b)
{
    return std::max({std::abs(a.red - b.red), std::abs(a.green - b.green), std::abs(a.blue - b.blue)});
}

/// The mean place of pixels of just this colour; nothing where there are fewer than 8.
std::optional<Pixel> middleOfColor(const Picture& picture, Rgb color)
{
    double x = 0, y = 0;
    int count = 0;
    for (int row = 0; row < picture.height; ++row)
        for (int column = 0; column < picture.width; ++column)
            if (apart(picture.at(column, row), color) <= 2) {
                x += column + 0.5;
                y += row + 0.5;
                ++count;
            }
    return count >= 8 ? std::optional(Pixel{x / count, y / count}) : std::nullopt;
}

int greenish(const Picture& picture)
{
    int count = 0;
    for (std::size_t n = 0; n < picture.rgb.size(); n += 3)
        count += picture.rgb[n + 1] > picture.rgb[n] + 10 && picture.rgb[n + 1] > 40 ? 1 : 0;
    return count;
}

Marker markerOn(Point3 p)
{
    Marker marker;
    marker.id = "m1";
    marker.position_mm = p;
    marker.color = MarkerColor::red;
    return marker;
}

SnapshotRequest cubeRequest(const test::TestColon& colon)
{
    SnapshotRequest request;
    request.view = SnapshotView::cube;
    request.station_mm = colon.polyp_station_mm;
    request.width = 800;
    request.height = 600;
    request.captioned = false;
    return request;
}

TEST_F(Panorama, TheCubesFacesGoOnInOneAnotherAndAMarkerIsWhereItIsSeen)
{
    const PreparedScan files = scan();
    SnapshotRequest request = cubeRequest(colon);
    const auto file = folder / "cube.png";
    const SnapshotResult plain = renderSnapshot(files, request, file);
    const Picture bare = readPicture(file);
    const CubeLayout layout(800, 600);
    // Across the edge of front and right, of front and left, of right and back.
    for (const int edge : {200, 400, 600}) {
        int largest = 0;
        for (int y = 250; y < 390; ++y)
            largest = std::max(largest, apart(bare.at(edge - 1, y), bare.at(edge, y)));
        EXPECT_LT(largest, 40) << "at " << edge;
    }
    for (const CubeFace face : kCubeFaces) {
        const Pixel corner = layout.cornerOf(face);
        const Rgb middle = bare.at(int(corner.x) + 100, int(corner.y) + 100);
        EXPECT_GT(middle.red, 20) << "a face shows wall";
    }
    request.markers = {markerOn(colon.polyp_mm)};
    renderSnapshot(files, request, file);
    const auto ring = middleOfColor(readPicture(file), colorOf(MarkerColor::red));
    ASSERT_TRUE(ring);
    const Pixel wanted = layout.toPixel(plain.pose, colon.polyp_mm);
    EXPECT_LT(std::hypot(ring->x - wanted.x, ring->y - wanted.y), 8);
}

TEST_F(Panorama, ACubeInTheReadingRoomPaintsAndCountsWhatItShows)
{
    const PreparedScan files = scan();
    ReadingPictures pictures(files);
    ScanCoverage seen(triangleAreas_mm2(files.cells().points_mm, files.cells().triangles));
    SnapshotRequest request = cubeRequest(colon);
    const ViewPose view = poseAtStation(files.frames(), files.lumen(), request.station_mm);
    const SnapshotResult place{view.pose, view.station_mm, view.clearance_mm, true};
    const Picture bare = pictures.cubeFace(request, place, CubeFace::left, true, {}, &seen);
    EXPECT_EQ(bare.width, 200);
    const double one_face = seen.fraction();
    EXPECT_GT(one_face, 0.01);
    pictures.cubeFace(request, place, CubeFace::right, true, {}, &seen);
    EXPECT_GT(seen.fraction(), one_face) << "another face shows other wall";
    EXPECT_EQ(greenish(bare), 0);
    seen.beginPass();
    EndoscopicLook look;
    look.earlier = &seen;
    EXPECT_GT(greenish(pictures.cubeFace(request, place, CubeFace::left, true, look, nullptr)), 10000);
}

TEST_F(Panorama, TheBandShowsAMarkerWhereItsWallIsAndTurnedAboutFromTheCaecum)
{
    const PreparedScan files = scan();
    NoProgress quiet;
    const BandMap band = bandOf(files, quiet);
    BandRequest request;
    request.width = 900;
    request.height = 260;
    request.middle_mm = colon.polyp_station_mm;
    request.markers = {markerOn(colon.polyp_mm)};
    for (const bool from_caecum : {false, true}) {
        request.from_caecum = from_caecum;
        const BandPicture drawn = bandPicture(files, band, request, quiet);
        const Pixel wanted = drawn.page.toPixel(band, band.placeOf(colon.polyp_mm));
        const auto under = drawn.pointAt(band, wanted);
        ASSERT_TRUE(under);
        EXPECT_LT(distance(*under, colon.polyp_mm), colon.polyp_radius_mm + 1);
        // Seen around the ring alone: its letters lie beside it, a repeated one elsewhere.
        Picture around(80, 80);
        for (int y = 0; y < 80; ++y)
            for (int x = 0; x < 80; ++x)
                around.set(x, y,
                           drawn.picture.at(std::clamp(int(wanted.x) - 40 + x, 0, 899),
                                            std::clamp(int(wanted.y) - 40 + y, 0, 259)));
        const auto ring = middleOfColor(around, colorOf(MarkerColor::red));
        ASSERT_TRUE(ring);
        EXPECT_LT(std::hypot(ring->x - 40, ring->y - 40), 8);
    }
}

TEST_F(Panorama, ABandAroundAStationMarksIt)
{
    const PreparedScan files = scan();
    SnapshotRequest request;
    request.view = SnapshotView::band;
    request.width = 900;
    request.height = 300;
    request.station_mm = 200;
    request.whole_band = false;
    const auto file = folder / "band.png";
    renderSnapshot(files, request, file);
    const Picture marked = readPicture(file);
    const auto greyAt = [&](int x, int y) {  // neither wall nor ground
        const Rgb color = marked.at(x, y);
        return color.red > 100 && std::abs(color.red - color.blue) < 25;
    };
    int most = 0, at = 0;
    for (int x = 0; x < marked.width; ++x) {
        int here = 0;
        for (int y = 0; y < marked.height; ++y)
            here += greyAt(x, y) ? 1 : 0;
        if (here > most) {
            most = here;
            at = x;
        }
    }
    EXPECT_GT(most, 50) << "a dashed line across";
    EXPECT_NEAR(at, 450, 2) << "in the middle";
}

TEST_F(Panorama, TheWholeBandIsWrittenWithoutAWindowAndSeenWallIsPaintedInIt)
{
    const PreparedScan files = scan();
    SnapshotRequest request;
    request.view = SnapshotView::band;
    request.caption.patient_name = "Phantom^Anna";
    const auto file = folder / "band.png";
    renderSnapshot(files, request, file);
    const Picture whole = readPicture(file);
    EXPECT_EQ(whole.width, 1024);
    int wall = 0;
    for (std::size_t n = 0; n < whole.rgb.size(); n += 3)
        wall += whole.rgb[n] > whole.rgb[n + 2] + 20 ? 1 : 0;
    EXPECT_GT(wall, 1024 * 768 / 4) << "most of it is wall";
    NoProgress quiet;
    const BandMap band = bandOf(files, quiet);
    BandRequest painted;
    painted.width = 900;
    painted.height = 260;
    painted.middle_mm = 100;
    EXPECT_EQ(greenish(bandPicture(files, band, painted, quiet).picture), 0);
    painted.seen.assign(files.cells().triangleCount(), 1);
    EXPECT_GT(greenish(bandPicture(files, band, painted, quiet).picture), 40000);
}

TEST_F(Panorama, TheBodySeenFromOutsideIsPickedPaintedAndMarkedAsItIsTurned)
{
    const PreparedScan files = scan();
    NoProgress quiet;
    TurnedRequest request;
    request.width = request.height = 400;
    request.markers = {markerOn(colon.polyp_mm)};
    const ViewPose view = poseAtStation(files.frames(), files.lumen(), 0);
    request.eye = {view.pose, view.station_mm, view.clearance_mm, true};
    for (const double by : {0.0, 120.0, 300.0}) {
        request.view.turn({by, 0.3 * by}, 200);
        const TurnedPicture drawn = turnedPicture(files, request, quiet);
        int picked = 0;
        for (int y = 5; y < 400; y += 16)
            for (int x = 5; x < 400; x += 16)
                if (const auto point = drawn.pointAt(colon.cells, {x + 0.5, y + 0.5})) {
                    ++picked;
                    const Pixel back = drawn.view.toPixel(*point);
                    EXPECT_LT(std::hypot(back.x - x - 0.5, back.y - y - 0.5), 1);
                }
        EXPECT_GT(picked, 40);
        EXPECT_TRUE(middleOfColor(drawn.picture, colorOf(MarkerColor::red)));
        EXPECT_LT(greenish(drawn.picture), 1000) << "but for the names of the ends";
    }
    request.seen.assign(files.cells().triangleCount(), 1);
    EXPECT_GT(greenish(turnedPicture(files, request, quiet).picture), 5000);
}

/// A stretch of the colon with the place in its middle, and no name.
PriorPlace stretchOf(const PreparedScan& files, double station_mm, double to_either_side_mm)
{
    return samePlace({}, files.skeleton(),
                     {station_mm, station_mm - to_either_side_mm, station_mm + to_either_side_mm});
}

int pixelsOf(const Picture& picture, Rgb color, const Area& area)
{
    int count = 0;
    for (int y = std::max(0, int(area.y)); y < std::min<double>(picture.height, area.bottom()); ++y)
        for (int x = std::max(0, int(area.x)); x < std::min<double>(picture.width, area.right()); ++x)
            count += apart(picture.at(x, y), color) <= 2;
    return count;
}

TEST_F(Panorama, WhereSomethingShouldLieIsSeenFromInsideAsRingsOnTheWallAtBothEndsOfTheStretch)
{
    const PreparedScan files = scan();
    const double station_mm = colon.polyp_station_mm, side_mm = 15;
    const PriorPlace place = stretchOf(files, station_mm, side_mm);
    EXPECT_EQ(place.least_mm, station_mm - side_mm);
    const PathFrame eye = files.frames().at(station_mm);
    const auto lines = priorRings(place, files.frames(), files.lumen(), eye.position_mm);
    std::array<int, 2> at_end{};
    for (const auto& line : lines)
        for (const Point3 p : line) {
            EXPECT_LT(files.lumen().clearance_mm(p), 2 * files.lumen().voxel_mm()) << "on the wall";
            bool across = false;
            for (const std::size_t end : {0U, 1U}) {
                const PathFrame frame = files.frames().at(station_mm + (end == 0 ? -side_mm : side_mm));
                const bool here = std::abs(dot(p - frame.position_mm, frame.forward)) < 1e-6;
                at_end[end] += here;
                across = across || here;
            }
            EXPECT_TRUE(across) << "where the stretch begins or ends";
        }
    constexpr int kMostOfIt = 40;  // of 72 corners
    EXPECT_GT(at_end[0], kMostOfIt);
    EXPECT_GT(at_end[1], kMostOfIt);
    const PathFrame away = files.frames().at(files.frames().length_mm());
    EXPECT_TRUE(priorRings(place, files.frames(), files.lumen(), away.position_mm).empty()) << "behind bends";
}

TEST_F(Panorama, WhereSomethingShouldLieIsShownFromInsideInCubeBandAndOnTheBodyThatTurns)
{
    const PreparedScan files = scan();
    NoProgress quiet;
    constexpr double kSide_mm = 15;
    const double station_mm = colon.polyp_station_mm;
    const std::vector<PriorPlace> stretch{stretchOf(files, station_mm, kSide_mm)};
    const auto all = [](const Picture& picture) {
        return pixelsOf(picture, kSamePlaceColor, {0, 0, double(picture.width), double(picture.height)});
    };

    SnapshotRequest cube = cubeRequest(colon);
    EXPECT_EQ(all(drawSnapshot(files, cube).picture), 0);
    cube.priors = stretch;
    EXPECT_GT(all(drawSnapshot(files, cube).picture), 100);
    SnapshotRequest inside = cube;
    inside.view = SnapshotView::endo;
    inside.priors = {stretchOf(files, station_mm, 2 * kSide_mm)};
    const DrawnSnapshot ahead = drawSnapshot(files, inside);
    writePng(folder / "ring.png", ahead.picture);
    EXPECT_GT(all(ahead.picture), 100) << "the end of the stretch, ahead";

    const BandMap band = bandOf(files, quiet);
    BandRequest request;
    request.width = 900;
    request.height = 300;
    request.middle_mm = station_mm;
    EXPECT_EQ(all(bandPicture(files, band, request, quiet).picture), 0);
    request.priors = stretch;
    for (const bool from_caecum : {false, true}) {
        request.from_caecum = from_caecum;
        const BandPicture drawn = bandPicture(files, band, request, quiet);
        const auto x = [&](double station) { return drawn.page.toPixel(band, {station, 0}).x; };
        const double one = x(station_mm - kSide_mm), other = x(station_mm + kSide_mm);
        for (const double end : {one, other})
            EXPECT_GT(pixelsOf(drawn.picture, kSamePlaceColor, {end - 2, 0, 4, 300}), 50) << from_caecum;
        const double first = std::min(one, other), last = std::max(one, other);
        EXPECT_EQ(pixelsOf(drawn.picture, kSamePlaceColor, {0, 0, first - 4, 300}), 0) << "nothing before it";
        EXPECT_EQ(pixelsOf(drawn.picture, kSamePlaceColor, {last + 4, 0, 900, 300}), 0) << "nothing after it";
    }

    TurnedRequest turned;
    turned.width = turned.height = 400;
    turned.view.turn({120, 40}, 200);
    EXPECT_EQ(all(turnedPicture(files, turned, quiet).picture), 0);
    turned.priors = stretch;
    const TurnedPicture drawn = turnedPicture(files, turned, quiet);
    const Pixel middle = drawn.view.toPixel(files.skeleton().at(station_mm).position_mm);
    const double near_px = (kSide_mm + 12) / drawn.view.mm_per_pixel;  // and the disc in its middle
    const int there =
        pixelsOf(drawn.picture, kSamePlaceColor, {middle.x - near_px, middle.y - near_px, 2 * near_px, 2 * near_px});
    EXPECT_GT(there, 30);
    EXPECT_EQ(there, all(drawn.picture)) << "nowhere else";
}

TEST_F(Panorama, WhatIsNoLongerWantedStops)
{
    struct Stopped : NoProgress {
        bool cancelled() const override { return true; }
    } stopped;
    NoProgress quiet;
    const PreparedScan files = scan();
    const BandMap band = bandOf(files, quiet);
    BandRequest request;
    request.width = request.height = 300;
    TurnedRequest turned;
    turned.width = turned.height = 300;
    EXPECT_THROW(bandPicture(files, band, request, stopped), Error);
    EXPECT_THROW(turnedPicture(files, turned, stopped), Error);
}

}  // namespace
}  // namespace vicon::viewer
