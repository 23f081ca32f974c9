#include "layout_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "report_samples.h"
#include "vicon/core/file.h"
#include "vicon/picture/png_file.h"

namespace fs = std::filesystem;

namespace vicon::report::samples {
namespace {

constexpr double kNear_pt = 1;
constexpr int kDotsAnInch = 24, kOtherShade = 40, kMostOtherDots = 12;

bool keepsAnew()
{
    return std::getenv("VICON_KEEP_LAYOUT") != nullptr;
}

void expectWords(const std::vector<std::vector<Word>>& pages, const fs::path& kept)
{
    if (keepsAnew()) {
        std::ostringstream out;
        for (std::size_t page = 0; page < pages.size(); ++page)
            for (const Word& word : pages[page])
                out << page + 1 << ' ' << std::lround(word.left) << ' ' << std::lround(word.top) << ' '
                    << std::lround(word.right) << ' ' << std::lround(word.bottom) << ' ' << word.text << '\n';
        replaceFile(kept, out.str());
    }
    std::ifstream in(kept);
    ASSERT_TRUE(in.good()) << kept;
    for (std::size_t page = 0; page < pages.size(); ++page)
        for (const Word& word : pages[page]) {
            std::size_t on = 0;
            double left = 0, top = 0, right = 0, bottom = 0;
            std::string text;
            in >> on >> left >> top >> right >> bottom >> text;
            ASSERT_TRUE(on == page + 1 && text == word.text) << kept << ": '" << word.text << "' is new";
            ASSERT_TRUE(std::abs(left - word.left) <= kNear_pt && std::abs(right - word.right) <= kNear_pt &&
                        std::abs(top - word.top) <= kNear_pt && std::abs(bottom - word.bottom) <= kNear_pt)
                << kept << ": '" << text << "' on page " << on << " has moved to " << word.left << ", " << word.top;
        }
    std::string more;
    EXPECT_FALSE(in >> more) << kept << ": words are missing";
}

void expectInk(const Raster& page, const fs::path& kept)
{
    std::vector<std::uint8_t> grey;
    for (std::size_t n = 0; n < page.rgb.size(); n += 3)
        grey.push_back(std::uint8_t((page.rgb[n] + page.rgb[n + 1] + page.rgb[n + 2]) / 3));
    if (keepsAnew())
        picture::writePng(kept, page.width, page.height, grey);
    const picture::Picture before = picture::readPng(kept);
    ASSERT_EQ(before.width, page.width);
    ASSERT_EQ(before.height, page.height);
    int other = 0;
    for (std::size_t n = 0; n < grey.size(); ++n)
        other += std::abs(int(grey[n]) - int(before.pixels[n * std::size_t(before.channels)])) > kOtherShade;
    EXPECT_LE(other, kMostOtherDots) << kept;
}

}  // namespace

void expectLayout(const fs::path& pdf, const std::string& name)
{
    const fs::path folder = VICON_LAYOUT;
    const auto pages = wordsByPage(pdf);
    expectWords(pages, folder / (name + ".txt"));
    for (std::size_t page = 1; page <= pages.size(); ++page)
        expectInk(render(pdf, int(page), kDotsAnInch), folder / (name + "-" + std::to_string(page) + ".png"));
}

}  // namespace vicon::report::samples
