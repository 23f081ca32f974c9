// The proofs in full; the ordinary tests hold samples of them.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <random>
#include <string>

#include "render_checks.h"
#include "scan_fixture.h"
#include "submarine_checks.h"
#include "vicon/support/support.h"
#include "vicon/viewer/model/band_raster.h"

namespace vicon::viewer {
namespace {

struct LongFlights : test::ColonFixture {};

// The real scan and the default phantom, imported and worked through by the built command.
void forEachPreparedScan(const std::function<void(const PreparedScan&)>& check)
{
    const support::TemporaryFolder folder;
    const std::string phantom = (folder / "phantom").string(), store = (folder / "store").string();
    for (const std::string& arguments :
         {"phantom " + phantom + " --supine --seed 1",
          "import " + phantom + " " + support::sharedData("ctc-prone").string() + " --store " + store,
          "work --until-idle --store " + store}) {
        const support::CommandResult result = support::runVicon(arguments);
        ASSERT_EQ(result.exit_code, 0) << "vicon " << arguments << "\n" << result.output;
    }
    std::size_t scans = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(store))
        if (entry.path().filename() == "cells.vtp") {
            SCOPED_TRACE(entry.path().parent_path().filename().string());
            check(PreparedScan::open(entry.path().parent_path()));
            ++scans;
        }
    EXPECT_EQ(scans, 2U);
}

/// Neither end of the path goes there and back before it sets off.
void expectNoHooks(const PathFrames& path)
{
    const double length_mm = path.length_mm();
    for (double off_mm = 1; off_mm <= 60; ++off_mm) {
        EXPECT_GT(distance(path.at(0).position_mm, path.at(off_mm).position_mm), off_mm / 3) << off_mm;
        EXPECT_GT(distance(path.at(length_mm).position_mm, path.at(length_mm - off_mm).position_mm), off_mm / 3)
            << off_mm << " from the caecal end";
    }
}

bool inFullTurn(const BandPage& page, const BandMap& band, int x, int y)
{
    return std::abs(page.placeAt(band, {x + 0.5, y + 0.5}).around_rad) <= BandPage::kTurn_rad / 2;
}

/// How far the wall at the pixel that a pixel's point leads back to lies from that point, of pixels at random.
double worstWayBack_mm(const BandMap& band, const BandRaster& raster, std::size_t count)
{
    const BandPage& page = raster.page();
    std::mt19937 random(7);
    double worst_mm = 0;
    for (std::size_t tried = 0; tried < count;) {
        const int x = std::uniform_int_distribution(0, page.width - 1)(random);
        const int y = std::uniform_int_distribution(0, page.height - 1)(random);
        const auto hit = raster.at(x, y);
        if (!hit || !inFullTurn(page, band, x, y))
            continue;
        ++tried;
        const Point3 point = pointOf(band.surface(), *hit);
        const Pixel back = page.toPixel(band, band.placeOf(point), page.rowAt({x + 0.5, y + 0.5}));
        const auto again = raster.at(int(back.x), int(back.y));
        worst_mm = std::max(worst_mm, again ? distance(pointOf(band.surface(), *again), point) : HUGE_VAL);
    }
    return worst_mm;
}

TEST(LongPrepared, TheBandOfEachScanHoldsTheWallOnceAndLeadsBackToIt)
{
    VICON_NEEDS_DATA("ctc-prone");
    forEachPreparedScan([](const PreparedScan& scan) {
        NoProgress quiet;
        const BandMap band(scan.cells(), scan.frames(), scan.exitDistance(), quiet);
        BandPage page;
        page.width = 1400;
        page.height = 700;
        page.label_px = 12;
        const BandRaster raster(band, wholeBand(band, page));
        const double back_mm = worstWayBack_mm(band, raster, 300);
        double off = 0;
        for (std::size_t n = 0; n < scan.cells().pointCount(); ++n)
            off += std::abs(std::log2(band.areaFactor(n))) > 1 ? 1.0 / double(scan.cells().pointCount()) : 0;
        std::printf("%s: under other wall %.4f; back within %.3f mm; area off by two at %.3f of the points\n",
                    scan.folder().filename().c_str(), band.turnedShare(), back_mm, off);
        EXPECT_LT(band.turnedShare(), 0.025);
        EXPECT_LT(back_mm, 1);
    });
}

TEST(LongPrepared, AThousandCulledPicturesOfEachScanAreIdenticalToPicturesOfEverything)
{
    VICON_NEEDS_DATA("ctc-prone");
    const Display display;
    forEachPreparedScan([](const PreparedScan& scan) {
        test::expectCulledPicturesIdentical(scan, 1000, 7, 256);
        test::expectCulledPicturesIdentical(scan, 200, 8, 256, true);
    });
}

// One test for all, as preparing the scans takes longer than the flights.
TEST(LongPrepared, TheGuidedCameraKeepsOffTheWallFliesAlikeAtAnyFrameRateAndComesBackWhenReleased)
{
    VICON_NEEDS_DATA("ctc-prone");
    forEachPreparedScan([](const PreparedScan& scan) {
        expectNoHooks(scan.frames());
        const test::Course course{scan.frames(), scan.lumen(), scan.exitDistance(), scan.cells()};
        test::steerAtRandom(course, 1000000, 1000);
        for (unsigned n = 0; n < 20; ++n)
            test::flyAtTwoRates(course, scan.frames().length_mm() * n / 20, 9 + n);
        test::releasedAlong(course, 1000);
        test::pullToBothEnds(course);
    });
}

struct LongSubmarines : test::Submarines {};

TEST_F(LongFlights, AThousandCulledPicturesAreIdenticalToPicturesOfEverything)
{
    test::expectCulledPicturesIdentical(scan(), 1000, 2);
}

TEST_F(LongSubmarines, AMillionTicksNeverComeNearerToTheWallThanTheCamerasRadius)
{
    EXPECT_EQ(test::steerAtRandom(course, 1000000), 0);
}

}  // namespace
}  // namespace vicon::viewer
