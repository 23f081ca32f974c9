#include "vicon/viewer/model/scan_coverage.h"

#include <gtest/gtest.h>

namespace vicon::viewer {
namespace {

std::vector<float> areas()
{
    return {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
}

TEST(ScanCoverage, WhatIsSeenCountsAtOnceAndIsEarlierFromTheNextPassOn)
{
    ScanCoverage seen(areas());
    seen.see({0, 3});
    EXPECT_DOUBLE_EQ(seen.fraction(), 5.0 / 55);
    EXPECT_EQ(seen.earlier(), std::vector<std::uint8_t>(10, 0));
    seen.beginPass();
    seen.see({3, 4});
    EXPECT_EQ(seen.earlier(), (std::vector<std::uint8_t>{1, 0, 0, 1, 0, 0, 0, 0, 0, 0}));
    EXPECT_DOUBLE_EQ(seen.seenArea_mm2(), 10);
}

TEST(ScanCoverage, IsBackAfterPackingAndCountsAsEarlier)
{
    ScanCoverage seen(areas());
    seen.see({1, 7, 8, 9});
    ScanCoverage again(areas());
    ASSERT_TRUE(again.unpack(seen.packed()));
    EXPECT_DOUBLE_EQ(again.fraction(), seen.fraction());
    EXPECT_EQ(again.earlier(), (std::vector<std::uint8_t>{0, 1, 0, 0, 0, 0, 0, 1, 1, 1}));
}

TEST(ScanCoverage, TakesNothingOfAnotherSurfaceOrOfDamagedBytes)
{
    ScanCoverage seen(areas());
    seen.see({1, 2});
    const std::string packed = seen.packed();
    auto others = areas();
    others[4] = 5.5F;
    ScanCoverage other(others);
    EXPECT_FALSE(other.unpack(packed)) << "as many triangles, another surface";
    ScanCoverage same(areas());
    for (const std::string& bytes : {std::string(), packed.substr(0, packed.size() - 1), packed + "x"})
        EXPECT_FALSE(same.unpack(bytes));
    EXPECT_EQ(same.fraction(), 0);
    EXPECT_EQ(other.fraction(), 0);
}

}  // namespace
}  // namespace vicon::viewer
