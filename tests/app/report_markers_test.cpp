// A report lists every marker of its case, whatever became of the marker's scan.
#include <gtest/gtest.h>
#include <soci/soci.h>

#include "command.h"
#include "dicom_writer.h"
#include "report_writing.h"
#include "study.h"
#include "vicon/core/progress.h"

namespace vicon::support {
namespace {

class ReportOfAMarkedCase : public testing::TestWithParam<const char*> {
protected:
    TemporaryFolder folder;
};

TEST_P(ReportOfAMarkedCase, NeverDeniesTheMarker)
{
    vicon::test::SeriesSpec water;
    vicon::test::writeSeries(folder / "series", water);
    viconOn(folder / "store", "import " + (folder / "series").string());
    CaseStore store(folder / "store");
    const std::string case_id = store.cases().at(0).id;
    const ScanRecord scan = store.scans(case_id).at(0);
    store.saveMarker(case_id, {.scan_id = scan.id, .position_mm = {1, 2, 3}, .note = "polyp in the sigmoid"});
    store.database().session() << GetParam();
    NoProgress quiet;
    const auto written = app::writeReport(store, app::declaredConfig(), case_id, folder / "report.pdf", quiet);
    EXPECT_EQ(written.markers, 1u);
    const std::string text = runCommand("pdftotext " + (folder / "report.pdf").string() + " -").output;
    EXPECT_NE(text.find("Marker m1"), std::string::npos) << text;
    EXPECT_NE(text.find("polyp in the sigmoid"), std::string::npos) << text;
    EXPECT_EQ(text.find("No markers"), std::string::npos) << text;
}

INSTANTIATE_TEST_SUITE_P(WhateverItsScanIs, ReportOfAMarkedCase,
                         testing::Values("UPDATE scans SET role = 'scan'", "UPDATE scans SET role = 'kept'",
                                         "UPDATE scans SET role = 'refused'", "UPDATE scans SET id = 's0000000000'"));

}  // namespace
}  // namespace vicon::support
