#include "text_table.h"

#include <gtest/gtest.h>

#include <limits>

namespace vicon::app {
namespace {

TEST(TextTable, NumbersThatRoundToZeroHaveNoSign)
{
    EXPECT_EQ(formatNumber(-0.3, 0), "0");
    EXPECT_EQ(formatNumber(-0.04, 1), "0.0");
    EXPECT_EQ(formatNumber(-0.06, 1), "-0.1");
    EXPECT_EQ(formatNumber(-10, 0), "-10");
    EXPECT_EQ(formatNumber(12.34, 1), "12.3");
    EXPECT_EQ(formatNumber(-std::numeric_limits<double>::infinity(), 0), "-inf");
}

}  // namespace
}  // namespace vicon::app
