// The real scan, from the worklist to the report and back again.
#include <QTableWidget>

#include "study_walk.h"

namespace vicon::viewer::test {
namespace {

using RealScan = StudyWalk;

TEST_F(RealScan, IsReadFromWorklistToReportAndAllIsBackAfterReopening)
{
    VICON_NEEDS_DATA("ctc-prone");
    openStore(preparedStore("ctc-prone", support::sharedData("ctc-prone"), *folder_ / "ctc-prone"), "scan");
    screenshot("worklist");
    openCase(patient_id_.c_str());
    screenshot("opened");
    ASSERT_NO_FATAL_FAILURE(flyThereAndBack());
    ASSERT_NO_FATAL_FAILURE(markAndEdit());
    ASSERT_NO_FATAL_FAILURE(measure());
    ASSERT_NO_FATAL_FAILURE(lookBelowTheWall());
    ASSERT_NO_FATAL_FAILURE(circleAndTakeDensity());
    ASSERT_NO_FATAL_FAILURE(keepPictureAndMarkers());
    ASSERT_NO_FATAL_FAILURE(writeReport());
    ASSERT_NO_FATAL_FAILURE(closeAndReopen());
    EXPECT_EQ(stored(case_id_.c_str()).size(), 2U);
}

}  // namespace
}  // namespace vicon::viewer::test
