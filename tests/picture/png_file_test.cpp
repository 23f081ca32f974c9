#include "vicon/picture/png_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/support/support.h"

namespace fs = std::filesystem;

namespace vicon::picture {
namespace {

using testing::HasSubstr;
using testing::Not;

struct PngFile : testing::Test {
    support::TemporaryFolder folder;
    const fs::path file = folder / "picture.png";

    ErrorCode codeOfReading() const
    {
        try {
            readPng(file);
        } catch (const Error& e) {
            return e.code();
        }
        return ErrorCode::internal;
    }
};

TEST_F(PngFile, HoldsWhatWasWritten)
{
    for (const int channels : {3, 4}) {
        std::vector<std::uint8_t> pixels;
        for (int n = 0; n < 5 * 3 * channels; ++n)
            pixels.push_back(std::uint8_t(7 * n));
        writePng(file, 5, 3, pixels);
        const Picture read = readPng(file, channels);
        EXPECT_EQ(read.width, 5);
        EXPECT_EQ(read.height, 3);
        EXPECT_EQ(read.channels, channels);
        EXPECT_EQ(read.pixels, pixels);
    }
}

TEST_F(PngFile, OfGreyIsReadAsRgb)
{
    writePng(file, 2, 1, std::vector<std::uint8_t>{10, 200});
    EXPECT_EQ(readPng(file).pixels, (std::vector<std::uint8_t>{10, 10, 10, 200, 200, 200}));
}

TEST_F(PngFile, PutsWhatIsTransparentOnWhite)
{
    writePng(file, 2, 1, std::vector<std::uint8_t>{9, 9, 9, 0, 9, 9, 9, 255});
    EXPECT_EQ(readPng(file).pixels, (std::vector<std::uint8_t>{255, 255, 255, 9, 9, 9}));
}

TEST_F(PngFile, CarriesATextAndItsColorsMeaningOnlyWhereAsked)
{
    const std::vector<std::uint8_t> pixel{1, 2, 3};
    writePng(file, 1, 1, pixel);
    EXPECT_THAT(readFile(file), Not(testing::AnyOf(HasSubstr("tEXt"), HasSubstr("sRGB"))));
    writePng(file, 1, 1, pixel, {.says_srgb = true, .keyword = "vicon:mapping", .text = "{1}"});
    EXPECT_THAT(readFile(file), HasSubstr(std::string("tEXtvicon:mapping\0{1}", 21)));
    EXPECT_THAT(readFile(file), HasSubstr("sRGB"));
}

TEST_F(PngFile, ThatIsDamagedOrAbsentIsAnError)
{
    EXPECT_EQ(codeOfReading(), ErrorCode::not_found);
    writePng(file, 40, 40, std::vector<std::uint8_t>(4800, 77));
    const std::string whole = readFile(file);
    replaceFile(file, whole.substr(0, whole.size() / 2));
    EXPECT_EQ(codeOfReading(), ErrorCode::bad_input);
    replaceFile(file, "no picture");
    EXPECT_EQ(codeOfReading(), ErrorCode::bad_input);
}

TEST_F(PngFile, ThatClaimsMorePixelsThanAnyPictureIsRefused)
{
    writePng(file, 1, 1, std::vector<std::uint8_t>{1});
    std::string bytes = readFile(file);
    // Width and height of the header, 20000 each, and its checksum.
    bytes.replace(16, 8, std::string("\0\0\x4e\x20\0\0\x4e\x20", 8));
    bytes.replace(29, 4, std::string("\xc6\x1b\x19\xe5", 4));
    replaceFile(file, bytes);
    EXPECT_THAT([&] { readPng(file); }, testing::ThrowsMessage<Error>(HasSubstr("too large")));
}

TEST_F(PngFile, ThatCannotBeWrittenIsOneErrorThatNamesIt)
{
    try {
        writePng(folder / "nowhere" / "picture.png", 1, 1, std::vector<std::uint8_t>{1, 2, 3});
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::store);
        EXPECT_THAT(e.subject(), HasSubstr("nowhere"));
    }
}

}  // namespace
}  // namespace vicon::picture
