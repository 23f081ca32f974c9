// What Retry in the worklist does, with the real pipeline.
#include <gtest/gtest.h>

#include "command.h"
#include "dicom_writer.h"
#include "reading_services.h"
#include "study.h"
#include "vicon/cases/corrections.h"

namespace vicon::support {
namespace {

TEST(RetryOfTheWorklist, ForgetsCorrectionsThatLeftNoColonAndLeavesOthers)
{
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "store";
    vicon::test::SeriesSpec water;
    water.slices = 20;
    vicon::test::writeSeries(folder / "series", water);
    viconOn(path, "import " + (folder / "series").string());
    viconOn(path, "work --until-idle");
    const auto config = app::declaredConfig();
    const viewer::ReadingServices services = app::readingServices(path, config);
    CaseStore store(path);
    const auto scan = [&] { return services.worklist(store, {}).cases.at(0).scans.at(0); };
    EXPECT_FALSE(scan().ready()) << "there is no colon";
    EXPECT_FALSE(scan().spoiled()) << "which nobody caused";
    const ScanRecord record = scan().record;
    services.correct(store, record, {}, {{}, {}, {{0, 0, 0}}});
    viconOn(path, "work --until-idle");
    EXPECT_TRUE(scan().spoiled()) << nameOf(scan().state) << ": " << scan().reason;
    services.retry(store, record.case_id);
    EXPECT_EQ(scan().state, WorkState::queued);
    EXPECT_TRUE(readCorrections(store.scanFolder(record.case_id, record.id)).empty());
}

}  // namespace
}  // namespace vicon::support
