// The proofs in full; the ordinary tests hold samples of them.
#include <filesystem>
#include <string>

#include "render_checks.h"
#include "scan_fixture.h"
#include "submarine_checks.h"
#include "vicon/support/support.h"

namespace vicon::viewer {
namespace {

struct LongFlights : test::ColonFixture {};

// The real scan and the default phantom, imported and worked through by the built command.
TEST(LongPrepared, AThousandCulledPicturesOfEachScanAreIdenticalToPicturesOfEverything)
{
    VICON_NEEDS_DATA("ctc-prone");
    const support::TemporaryFolder folder;
    const std::string phantom = (folder / "phantom").string(), store = (folder / "store").string();
    for (const std::string& arguments :
         {"phantom " + phantom + " --supine --seed 1",
          "import " + phantom + " " + support::sharedData("ctc-prone").string() + " --store " + store,
          "work --until-idle --store " + store}) {
        const support::CommandResult result = support::runVicon(arguments);
        ASSERT_EQ(result.exit_code, 0) << "vicon " << arguments << "\n" << result.output;
    }
    const Display display;
    std::size_t scans = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(store))
        if (entry.path().filename() == "cells.vtp") {
            SCOPED_TRACE(entry.path().parent_path().filename().string());
            test::expectCulledPicturesIdentical(PreparedScan::open(entry.path().parent_path()), 1000, 7, 256);
            ++scans;
        }
    EXPECT_EQ(scans, 2U);
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
