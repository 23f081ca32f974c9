// The proofs in full; the ordinary tests hold samples of them.
#include <cstdlib>
#include <filesystem>

#include "render_checks.h"
#include "scan_fixture.h"
#include "submarine_checks.h"

namespace vicon::viewer {
namespace {

struct LongFlights : test::ColonFixture {};

// Prepared scans of a store that VICON_TEST_STORE names (imported and worked through with 'vicon').
TEST(LongPrepared, AThousandCulledPicturesOfEachScanAreIdenticalToPicturesOfEverything)
{
    const char* store = std::getenv("VICON_TEST_STORE");
    if (!store)
        GTEST_SKIP() << "VICON_TEST_STORE names no store with prepared scans";
    const Display display;
    std::size_t scans = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(store))
        if (entry.path().filename() == "cells.vtp") {
            SCOPED_TRACE(entry.path().parent_path().filename().string());
            test::expectCulledPicturesIdentical(PreparedScan::open(entry.path().parent_path()), 1000, 7, 256);
            ++scans;
        }
    EXPECT_GT(scans, 0U);
}

struct LongSubmarines : test::Submarines {};

TEST_F(LongFlights, AThousandCulledPicturesAreIdenticalToPicturesOfEverything)
{
    test::expectCulledPicturesIdentical(scan(), 1000, 2);
}

TEST_F(LongSubmarines, AMillionTicksNeverComeNearerToTheWallThanTheCamerasRadius)
{
    test::steerAtRandom(*this, 1000000);
}

}  // namespace
}  // namespace vicon::viewer
