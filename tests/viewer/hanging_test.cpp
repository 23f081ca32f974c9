#include "vicon/viewer/model/hanging.h"

#include <gtest/gtest.h>

namespace vicon::viewer {
namespace {

TEST(Hangings, AreKeptWholeAndRubbishIsNotTakenForOne)
{
    Hanging mine;
    mine.layout = ViewLayout::both_scans;
    mine.plane = SlicePlane::sagittal;
    mine.slices.window = {"by hand", 420, -35};
    mine.slices.thick = {ThickSlice::Kind::minimum, 10};
    mine.slices.tracks = true;
    const Hanging usual = usualHangings()[1];
    const Hanging read = hangingFrom(toText(mine), usual);
    EXPECT_EQ(read.layout, mine.layout);
    EXPECT_EQ(read.plane, mine.plane);
    EXPECT_EQ(read.slices.window.name, "by hand");
    EXPECT_EQ(read.slices.window.width_hu, 420);
    EXPECT_EQ(read.slices.window.level_hu, -35);
    EXPECT_EQ(read.slices.thick, mine.slices.thick);
    EXPECT_TRUE(read.slices.tracks);
    std::string other_layout = toText(mine);
    other_layout.replace(other_layout.find("\"layout\":2"), 10, "\"layout\":9");
    for (const std::string& rubbish : {std::string(), std::string("{}"), std::string("[1"), other_layout}) {
        EXPECT_EQ(hangingFrom(rubbish, usual).layout, ViewLayout::two_d_first) << rubbish;
        EXPECT_EQ(hangingFrom(rubbish, usual).slices.window.name, "") << rubbish;
    }
}

TEST(Hangings, ThereIsOneForEachLayoutAndTheSliceReaderFollowsTheLumen)
{
    const auto all = usualHangings();
    for (std::size_t n = 0; n < all.size(); ++n) {
        EXPECT_EQ(std::size_t(all[n].layout), n);
        EXPECT_EQ(all[n].slices.tracks, all[n].layout == ViewLayout::two_d_first);
        EXPECT_FALSE(nameOf(all[n].layout).empty());
    }
}

}  // namespace
}  // namespace vicon::viewer
