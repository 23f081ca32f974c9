#include "vicon/viewer/model/reading_clock.h"

#include <gtest/gtest.h>

namespace vicon::viewer {
namespace {

TEST(ReadingClock, CountsScanAndCaseWithoutPauses)
{
    ReadingClock clock;
    clock.beginScan();
    clock.pass(10, true, false);
    clock.pass(300, false, false);
    clock.pass(5, true, true);
    EXPECT_EQ(clock.scan_s(), 15);
    EXPECT_EQ(clock.slicesFirst_s(), 5);
    clock.beginScan();
    EXPECT_EQ(clock.scan_s(), 0);
    EXPECT_EQ(clock.slicesFirst_s(), 0);
    clock.pass(20, true, false);
    EXPECT_EQ(clock.scan_s(), 20);
    EXPECT_EQ(clock.case_s(), 35) << "both scans";
}

}  // namespace
}  // namespace vicon::viewer
