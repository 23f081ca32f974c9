// A report lists every marker of its case, whatever became of the marker's scan.
#include <gtest/gtest.h>
#include <soci/soci.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "command.h"
#include "dicom_writer.h"
#include "report_folder.h"
#include "report_pictures.h"
#include "report_writing.h"
#include "study.h"
#include "vicon/cases/report_files.h"
#include "vicon/core/file.h"
#include "vicon/core/progress.h"

namespace fs = std::filesystem;

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
    EXPECT_TRUE(app::previewReport(store, app::declaredConfig(), case_id, quiet).starts_with("%PDF"));
    EXPECT_TRUE(countReports(store, store.cases()).empty()) << "what was looked at was not written";
    const auto written = app::writeReport(store, app::declaredConfig(), case_id, folder / "report.pdf", quiet);
    EXPECT_EQ(written.markers, 1u);
    EXPECT_EQ(written.number, 1);
    const std::string text = runCommand("pdftotext " + (folder / "report.pdf").string() + " -").output;
    EXPECT_NE(text.find("Marker m1"), std::string::npos) << text;
    EXPECT_NE(text.find("polyp in the sigmoid"), std::string::npos) << text;
    EXPECT_EQ(text.find("No markers"), std::string::npos) << text;
}

TEST(LookBelowTheWall, EndsHalfwayToTheMiddleOfASmallFinding)
{
    ReadCase read;
    for (const auto& [id, size_mm] : {std::pair{"m1", 5.0}, {"m2", 8.0}, {"m3", 30.0}}) {
        FindingWithFacts& added = read.findings.emplace_back();
        added.finding.markers = {id};
        added.facts.size_mm = size_mm;
    }
    read.findings.emplace_back().finding.markers = {"m4"};
    EXPECT_DOUBLE_EQ(app::depthBelow_mm(read, "m1"), 1.25);
    for (const char* id : {"m2", "m3"})
        EXPECT_DOUBLE_EQ(app::depthBelow_mm(read, id), 2) << id;
    for (const char* id : {"m4", "m5"})
        EXPECT_DOUBLE_EQ(app::depthBelow_mm(read, id), 2) << id << ", of no known size";
}

TEST(ReportFolder, OfAKilledCommandGoesWithTheNextOneAndThatOfARunningOneStays)
{
    const TemporaryFolder temporary;
    ::setenv("TMPDIR", temporary.path().c_str(), 1);
    const auto folders = [&] {
        return std::distance(fs::directory_iterator(temporary.path()), fs::directory_iterator());
    };
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const app::ReportFolder pictures;
        replaceFile(pictures / "m1.png", "a picture");
        ::write(ready[1], "r", 1);
        ::pause();
        ::_exit(0);
    }
    char byte = 0;
    ASSERT_EQ(::read(ready[0], &byte, 1), 1);
    {
        const app::ReportFolder beside;
        EXPECT_EQ(folders(), 2) << "the other command runs";
    }
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    EXPECT_EQ(folders(), 1);
    {
        const app::ReportFolder next;
        EXPECT_EQ(folders(), 1);
    }
    EXPECT_EQ(folders(), 0);
    ::unsetenv("TMPDIR");
}

INSTANTIATE_TEST_SUITE_P(WhateverItsScanIs, ReportOfAMarkedCase,
                         testing::Values("UPDATE scans SET role = 'scan'", "UPDATE scans SET role = 'kept'",
                                         "UPDATE scans SET role = 'refused'", "UPDATE scans SET id = 's0000000000'"));

}  // namespace
}  // namespace vicon::support
