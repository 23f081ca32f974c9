// The real scan, from the worklist to the report and back again.
#include <QTableWidget>

#include "study_walk.h"

namespace vicon::viewer::test {
namespace {

class RealScan : public StudyWalk {
protected:
    void openScan()
    {
        patience_ms = 300000;  // more than a gigabyte to read, beside whatever else the machine does
        const char* name = testing::UnitTest::GetInstance()->current_test_info()->name();
        openStore(preparedStore("ctc-prone", support::sharedData("ctc-prone"), *folder_ / name), "scan");
        screenshot("worklist");
        openCase(patient_id_.c_str());
        screenshot("opened");
    }
};

TEST_F(RealScan, IsFlownFromRectumToCaecumAndBack)
{
    VICON_NEEDS_DATA("ctc-prone");
    ASSERT_NO_FATAL_FAILURE(openScan());
    ASSERT_NO_FATAL_FAILURE(flyThereAndBack());
    closeCase();
}

TEST_F(RealScan, IsReadFromWorklistToReportAndAllIsBackAfterReopening)
{
    VICON_NEEDS_DATA("ctc-prone");
    ASSERT_NO_FATAL_FAILURE(openScan());
    fastest();
    ASSERT_NO_FATAL_FAILURE(markAndEdit());
    ASSERT_NO_FATAL_FAILURE(measure());
    ASSERT_NO_FATAL_FAILURE(lookBelowTheWall());
    ASSERT_NO_FATAL_FAILURE(circleAndTakeDensity());
    ASSERT_NO_FATAL_FAILURE(keepPictureAndMarkers());
    ASSERT_NO_FATAL_FAILURE(writeReport());
    ASSERT_NO_FATAL_FAILURE(signReport());
    ASSERT_NO_FATAL_FAILURE(closeAndReopen());
    EXPECT_EQ(stored(case_id_.c_str()).size(), 2U);
    closeCase();
}

}  // namespace
}  // namespace vicon::viewer::test
