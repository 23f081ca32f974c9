#include "text_table.h"

#include <gtest/gtest.h>

#include <algorithm>
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

TEST(TextTable, OfWordsFromOutsideCommandsNoTerminalAndKeepsItsLines)
{
    const std::string table = formatTable({"ID", "NOTE"}, {{"m1", "a\x1b[31mred\nnew line"}, {"m2", "polyp"}});
    EXPECT_EQ(table.find('\x1b'), std::string::npos);
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3);
    EXPECT_NE(table.find("red\\nnew line"), std::string::npos) << table;
}

}  // namespace
}  // namespace vicon::app
