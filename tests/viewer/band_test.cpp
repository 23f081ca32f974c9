#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "bent_tube.h"
#include "test_colon.h"
#include "vicon/core/error.h"
#include "vicon/viewer/model/band_raster.h"

namespace vicon::viewer {
namespace {

using test::BentTube;
using test::TestColon;

constexpr double kPi = std::numbers::pi;

BandMap bandOf(const BentTube& tube, const PathFrames& path)
{
    NoProgress quiet;
    return {tube.surface, path, tube.exit_distance, quiet};
}

BandMap bandOf(const TestColon& colon, const PathFrames& path)
{
    NoProgress quiet;
    return {colon.cells, path, colon.exit_distance, quiet};
}

BandPage pageOf(const BandMap& band, int width, int height, bool from_caecum = false)
{
    BandPage page;
    page.width = width;
    page.height = height;
    page.from_caecum = from_caecum;
    page.label_px = 12;
    return wholeBand(band, page);
}

bool inFullTurn(const BandPage& page, const BandMap& band, int x, int y)
{
    return std::abs(page.placeAt(band, {x + 0.5, y + 0.5}).around_rad) <= kPi;
}

/// Connected groups of pixels of the full turn.
struct Blob {
    int pixels = 0, left = 1 << 20, right = 0, top = 1 << 20, bottom = 0;
    double roundness() const { return double(right - left + 1) / (bottom - top + 1); }
};

std::vector<Blob> blobsWhere(const BandRaster& raster, const BandMap& band, const std::function<bool(Point3)>& chosen)
{
    const BandPage& page = raster.page();
    std::vector<std::uint8_t> on(std::size_t(page.width) * std::size_t(page.height), 0);
    const auto at = [&](int x, int y) -> std::uint8_t& { return on[std::size_t(y * page.width + x)]; };
    for (int y = 0; y < page.height; ++y)
        for (int x = 0; x < page.width; ++x)
            if (const auto hit = raster.at(x, y); hit && inFullTurn(page, band, x, y))
                at(x, y) = chosen(pointOf(band.surface(), *hit)) ? 1 : 0;
    std::vector<Blob> blobs;
    for (int y = 0; y < page.height; ++y)
        for (int x = 0; x < page.width; ++x) {
            if (!at(x, y))
                continue;
            Blob blob;
            std::vector<std::pair<int, int>> open{{x, y}};
            at(x, y) = 0;
            while (!open.empty()) {
                const auto [px, py] = open.back();
                open.pop_back();
                ++blob.pixels;
                blob.left = std::min(blob.left, px), blob.right = std::max(blob.right, px);
                blob.top = std::min(blob.top, py), blob.bottom = std::max(blob.bottom, py);
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx) {
                        const int nx = px + dx, ny = py + dy;
                        if (nx >= 0 && ny >= 0 && nx < page.width && ny < page.height && at(nx, ny)) {
                            at(nx, ny) = 0;
                            open.emplace_back(nx, ny);
                        }
                    }
            }
            blobs.push_back(blob);
        }
    return blobs;
}

double areaOf(const CellSurface& s, std::size_t t)
{
    const std::uint32_t* c = &s.triangles[3 * t];
    return length(cross(s.point(c[1]) - s.point(c[0]), s.point(c[2]) - s.point(c[0]))) / 2;
}

TEST(Band, EveryTriangleHasOnePlaceAndIsSeenThere)
{
    const TestColon colon;
    const PathFrames path(colon.skeleton);
    const BandMap band = bandOf(colon, path);
    for (std::size_t t = 0; t < colon.cells.triangleCount(); ++t) {
        const auto corners = band.cornersOf(t);
        const double middle = (corners[0].around_rad + corners[1].around_rad + corners[2].around_rad) / 3;
        ASSERT_LE(std::abs(middle), kPi + 1e-6);
        for (const BandPlace& corner : corners) {
            ASSERT_GE(corner.station_mm, band.firstStation_mm() - 1e-3);
            ASSERT_LE(corner.station_mm, band.lastStation_mm() + 1e-3);
        }
    }
    EXPECT_LT(band.turnedShare(), 0.01);
    // So fine that each triangle that is not folded under covers a pixel.
    const BandPage page = pageOf(band, 3000, 2400);
    const BandRaster raster(band, page);
    std::set<std::uint32_t> seen;
    for (int y = 0; y < page.height; ++y)
        for (int x = 0; x < page.width; ++x)
            if (const auto hit = raster.at(x, y); hit && inFullTurn(page, band, x, y))
                seen.insert(hit->triangle);
    double whole = 0, shown = 0;
    for (std::size_t t = 0; t < colon.cells.triangleCount(); ++t) {
        whole += areaOf(colon.cells, t);
        shown += seen.contains(std::uint32_t(t)) ? areaOf(colon.cells, t) : 0;
    }
    EXPECT_GT(shown / whole, 0.99);
}

TEST(Band, APixelIsAPointOfTheWallAndThatPointIsThePixel)
{
    const TestColon colon;
    const PathFrames path(colon.skeleton);
    const BandMap band = bandOf(colon, path);
    std::mt19937 random(7);
    for (const bool from_caecum : {false, true}) {
        const BandPage page = pageOf(band, 1400, 700, from_caecum);
        const BandRaster raster(band, page);
        int tried = 0;
        while (tried < 60) {
            const int x = std::uniform_int_distribution(0, page.width - 1)(random);
            const int y = std::uniform_int_distribution(0, page.height - 1)(random);
            const auto hit = raster.at(x, y);
            if (!hit || !inFullTurn(page, band, x, y))
                continue;
            ++tried;
            const Point3 point = pointOf(colon.cells, *hit);
            const int row = page.rowAt({x + 0.5, y + 0.5});
            const Pixel back = page.toPixel(band, band.placeOf(point), row);
            EXPECT_LT(std::hypot(back.x - x - 0.5, back.y - y - 0.5) * page.mm_per_pixel, 1)
                << x << ", " << y << " is " << back.x << ", " << back.y;
            const auto again = raster.at(int(back.x), int(back.y));
            ASSERT_TRUE(again);
            EXPECT_LT(distance(pointOf(colon.cells, *again), point), 1);
        }
    }
}

class BandBend : public testing::TestWithParam<double> {};

TEST_P(BandBend, PolypsOfSixMillimetresInABendAreThereOnceAndInAWideOneRound)
{
    constexpr double kRadius_mm = 3;
    const BentTube tube(GetParam(), 15, {{0.35, 0}, {0.65, 0.5}, {0.5, kPi}, {0.2, kPi / 2}}, kRadius_mm);
    const PathFrames path(tube.skeleton);
    const BandMap band = bandOf(tube, path);
    const BandRaster raster(band, pageOf(band, 1600, 500));
    for (const Point3 polyp : tube.polyps_mm) {
        const auto blobs = blobsWhere(raster, band, [&](Point3 p) { return distance(p, polyp) < kRadius_mm + 0.2; });
        ASSERT_EQ(blobs.size(), 1U) << "polyp at " << polyp.x << ", " << polyp.y << ", " << polyp.z;
        const double mm = raster.page().mm_per_pixel;
        const double seen_mm2 = blobs[0].pixels * mm * mm, disc_mm2 = kPi * kRadius_mm * kRadius_mm;
        EXPECT_GT(seen_mm2, 0.3 * disc_mm2) << "as large as one of 3.3 mm";
        if (GetParam() < 30)
            continue;
        EXPECT_GT(blobs[0].roundness(), 0.5);
        EXPECT_LT(blobs[0].roundness(), 2);
    }
}

// Lumens of 15 mm radius. In a bend as tight as 20 mm the inside is a quarter as long as the path.
INSTANTIATE_TEST_SUITE_P(OfRadius, BandBend, testing::Values(20.0, 40.0));

TEST(Band, IsSeenFromInsideAndNotMirroredFromEitherEnd)
{
    const TestColon colon;
    const PathFrames path(colon.skeleton);
    const BandMap band = bandOf(colon, path);
    // The polyp, as one inside sees it who looks at it with the caecum to the right: what is above it?
    const Vector3 on = colon.skeleton.tangentAt(colon.polyp_station_mm);
    const Point3 middle = colon.skeleton.at(colon.polyp_station_mm).position_mm;
    const Vector3 look = normalized(colon.polyp_mm - middle);
    const Vector3 above = normalized(cross(on, look));
    const auto onWall = [&](Vector3 away) { return middle + normalized(look + away * 0.6) * 12 + on * 0.0; };
    const BandPlace polyp = band.placeOf(colon.polyp_mm), higher = band.placeOf(onWall(above)),
                    lower = band.placeOf(onWall(-above));
    EXPECT_NEAR(polyp.station_mm, colon.polyp_station_mm, 3);
    for (const bool from_caecum : {false, true}) {
        const BandPage page = pageOf(band, 2000, 1400, from_caecum);
        const int row = page.rowOf(polyp.station_mm);
        const auto at = [&](BandPlace place) {  // beside the polyp, also across the cut
            place.around_rad = polyp.around_rad + std::remainder(place.around_rad - polyp.around_rad, 2 * kPi);
            return page.toPixel(band, place, row);
        };
        const double up = from_caecum ? -1 : 1;
        EXPECT_GT(up * (at(polyp).y - at(higher).y), 3);
        EXPECT_LT(up * (at(polyp).y - at(lower).y), -3);
        EXPECT_GT(up * (at({polyp.station_mm + 10, polyp.around_rad}).x - at(polyp).x), 3);
    }
}

TEST(Band, ATubesAreasAreKeptAndHalfThoseOfACrowdedBendAreSaidToBeOff)
{
    const BentTube tube(20, 15, {}, 3);
    const PathFrames path(tube.skeleton);
    const BandMap band = bandOf(tube, path);
    int straight = 0, inside = 0;
    for (std::size_t n = 0; n < tube.surface.pointCount(); ++n) {
        const Point3 p = tube.surface.point(n);
        if (p.y < -30 && p.y > -45) {
            EXPECT_NEAR(band.areaFactor(n), 1, 0.2) << p.x << ", " << p.y << ", " << p.z;
            ++straight;
        } else if (p.y > 5 && std::hypot(p.x, p.y) < 6) {  // a quarter as long as the path beside it
            EXPECT_GT(band.areaFactor(n), 2);
            ++inside;
        }
    }
    EXPECT_GT(straight, 1000);
    EXPECT_GT(inside, 20);
}

TEST(Band, StopsWhenItIsNotWantedAnyMore)
{
    struct Stopped : NoProgress {
        bool cancelled() const override { return true; }
    } stopped;
    const BentTube tube(20, 8, {}, 3);
    const PathFrames path(tube.skeleton);
    EXPECT_THROW(BandMap(tube.surface, path, tube.exit_distance, stopped), Error);
}

TEST(Band, RowsGoOnWhereTheOneAboveEnds)
{
    const TestColon colon;
    const PathFrames path(colon.skeleton);
    const BandMap band = bandOf(colon, path);
    const BandPage page = pageOf(band, 400, 600);
    ASSERT_GT(page.rows, 1);
    constexpr double kRounding_mm = 1e-6;
    EXPECT_GE(page.length_mm() + kRounding_mm, band.lastStation_mm() - band.firstStation_mm());
    for (int row = 1; row < page.rows; ++row) {
        EXPECT_LT(page.rowBegin_mm(row), page.rowMost_mm(row - 1));
        EXPECT_GT(page.rowBegin_mm(row), page.rowLeast_mm(row - 1));
    }
}

}  // namespace
}  // namespace vicon::viewer
