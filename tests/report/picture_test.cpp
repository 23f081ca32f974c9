#include "picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vicon/support/support.h"

namespace vicon::report {
namespace {

class PictureForPrint : public testing::Test {
protected:
    Picture printed(int width, int height, const std::vector<std::uint8_t>& rgb, int most_width)
    {
        picture::writePng(folder_ / "one.png", width, height, rgb);
        return readForPrint(folder_ / "one.png", most_width);
    }
    support::TemporaryFolder folder_;
};

TEST_F(PictureForPrint, OfWhatIsTooWideEachPixelIsTheMeanOfThoseItCovers)
{
    // Five columns of red 10, 20, 30, 40, 50 become two: each of two and a half.
    std::vector<std::uint8_t> rgb;
    for (int row = 0; row < 4; ++row)
        for (int column = 1; column <= 5; ++column)
            for (const int value : {10 * column, 100, 10 * row})
                rgb.push_back(std::uint8_t(value));
    const Picture small = printed(5, 4, rgb, 2);
    EXPECT_EQ(small.width, 2);
    ASSERT_EQ(small.height, 2) << "two fifths of four, rounded";
    EXPECT_EQ(small.channels, 3);
    EXPECT_EQ(small.pixels, (std::vector<std::uint8_t>{18, 100, 5, 42, 100, 5, 18, 100, 25, 42, 100, 25}));
}

TEST_F(PictureForPrint, ThatFitsStaysAndGreyIsOneChannel)
{
    const std::vector<std::uint8_t> grey{7, 7, 7, 200, 200, 200};
    const Picture kept = printed(2, 1, grey, 2);
    EXPECT_EQ(kept.channels, 1);
    EXPECT_EQ(kept.pixels, (std::vector<std::uint8_t>{7, 200}));
    const Picture thin = printed(2, 1, grey, 1);
    EXPECT_EQ(thin.height, 1) << "never none";
    EXPECT_EQ(thin.pixels, (std::vector<std::uint8_t>{104}));
}

}  // namespace
}  // namespace vicon::report
