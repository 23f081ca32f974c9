#include "vicon/viewer/scene/canvas.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vicon/viewer/model/annotate.h"

namespace vicon::viewer {
namespace {

Picture written(const std::string& words, double most_width = 1e9)
{
    Picture picture(400, 60);
    OverlayText text;
    text.at = {5, 5};
    text.text = words;
    text.height_px = 24;
    text.most_width_px = most_width;
    Overlay overlay;
    overlay.texts.push_back(text);
    paint(picture, overlay);
    return picture;
}

int inked(const Picture& picture, int from_x, int to_x)
{
    int count = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = from_x; x < to_x; ++x)
            count += picture.at(x, y).red > 100;
    return count;
}

TEST(Text, OfEveryScriptHasGlyphs)
{
    const std::string boxes = "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD";
    const struct {
        const char *script, *words;
    } cases[] = {{"Latin", "Jérôme"},       {"Greek", "Διονυσιος"},           {"Cyrillic", "Люкceмбypг"},
                 {"Arabic", "قباني لنزار"}, {"Hebrew", "שרון דבורה"},         {"Thai", "นายแพทย์"},
                 {"Chinese", "王 小東"},    {"Japanese", "やまだ 太郎 ﾔﾏﾀﾞ"}, {"Korean", "김희중"}};
    for (const auto& c : cases) {
        EXPECT_GT(inked(written(c.words), 0, 400), 60) << c.script;
        EXPECT_NE(written(c.words).rgb, written(boxes).rgb) << c.script;
        // No letter falls back to the sign for what no font has: with that sign the line has another look.
        EXPECT_NE(written(c.words).rgb, written(std::string(c.words) + boxes).rgb) << c.script;
    }
}

TEST(Text, FromRightToLeftIsInOrder)
{
    // The last letter stands at the left, and an override of the direction cannot turn the word.
    const Picture word = written("אבג"), last = written("ג");
    OverlayText letter;
    letter.text = "ג";
    letter.height_px = 24;
    const int end = 5 + int(textSize(letter).width_px) - 2;
    EXPECT_EQ(inked(word, 0, end), inked(last, 0, end));
    EXPECT_NE(inked(word, 0, end), inked(written("א"), 0, end));
    EXPECT_EQ(word.rgb, written("\u202Dאבג").rgb);
    // Arabic letters join: three of them side by side are wider when kept apart by U+200C.
    OverlayText joined, apart;
    joined.text = "ببب";
    apart.text = "ب\u200Cب\u200Cب";
    EXPECT_LT(textSize(joined).width_px, textSize(apart).width_px);
}

TEST(Text, OfScriptsThatStackAndReorderLettersIsShaped)
{
    const auto width = [](const std::string& words) {
        OverlayText text;
        text.text = words;
        text.height_px = 24;
        return textSize(text).width_px;
    };
    // A consonant below another, where U+200C keeps the two apart.
    EXPECT_LT(width("क्ष"), 0.8 * width("क्\u200Cष")) << "Devanagari";
    EXPECT_LT(width("క్ష"), 0.8 * width("క్\u200Cష")) << "Telugu";
    // A vowel that is written after its consonant and stands before it: the stem of the consonant is at the right.
    const auto inkOfLast = [&](const std::string& words) {
        const int end = int(width(words)) + 5;
        return inked(written(words), end - 6, end);
    };
    EXPECT_NEAR(inkOfLast("कि"), inkOfLast("क"), 0.3 * inkOfLast("क"));
    // An accent takes no room of its own.
    EXPECT_NEAR(width("e\u0301"), width("e"), 0.5);
}

TEST(Text, IsMadeSmallerUntilItFitsAndThenCutOff)
{
    OverlayText text;
    text.text = "Wolfeschlegelsteinhausenbergerdorff, H. B.";
    text.height_px = 24;
    const double whole = textSize(text).width_px;
    text.most_width_px = 0.7 * whole;
    EXPECT_LE(textSize(text).width_px, text.most_width_px + 1);
    EXPECT_NEAR(textSize(text).height_px, 0.7 * 1.2 * 24, 0.5) << "all of it, smaller";
    for (const double share : {0.5, 0.2, 0.01}) {
        text.most_width_px = share * whole;
        EXPECT_LE(textSize(text).width_px, std::max(text.most_width_px, 15.0));
        EXPECT_NEAR(textSize(text).height_px, 0.6 * 1.2 * 24, 0.01) << "no smaller than can be read";
    }
    EXPECT_EQ(inked(written(text.text, 300), 308, 400), 0);
    EXPECT_GT(inked(written(text.text, 300), 280, 308), 0);
    OverlayText cut = text;
    cut.most_width_px = 0.3 * whole;
    text.text = "Wolfeschlegelsteinhausenbergerdor, H. B.";  // another end, which is not shown
    text.most_width_px = 0.3 * whole;
    EXPECT_EQ(textSize(cut).width_px, textSize(text).width_px);
}

TEST(Text, OfOneBlockHasOneSize)
{
    const OverlayText name{.text = "Wolfeschlegelsteinhausenbergerdorff, H. B."}, date{.text = "1951"};
    const double whole = textSize({.text = name.text, .height_px = 24}).width_px;
    Overlay overlay;
    addLines(overlay, {0, 0, 0.7 * whole, 300}, {name, date}, 24);
    addLines(overlay, {0, 100, 2 * whole, 300}, {name, date}, 24);
    const std::vector<Area> areas = textAreas(overlay);
    ASSERT_EQ(areas.size(), 4U);
    EXPECT_LT(areas[0].height, 0.75 * areas[2].height) << "the name does not fit";
    EXPECT_EQ(areas[1].height, areas[0].height);
    EXPECT_EQ(areas[3].height, areas[2].height) << "another block";
    const double cut_off = 0.4 * whole;
    Overlay narrow;
    addLines(narrow, {0, 0, cut_off, 300}, {name, date}, 24);
    EXPECT_LE(textAreas(narrow)[0].width, cut_off);
    EXPECT_EQ(textAreas(narrow)[1].height, textAreas(narrow)[0].height);
}

TEST(Text, ThatBeginsNearAnEdgeIsMovedUntilItEndsInThePicture)
{
    const auto shown = [](Pixel at, Across across) {
        Picture picture(200, 60);
        Overlay overlay;
        overlay.texts.push_back({at, "m12", 24, {}, across, Along::bottom, 1e9});
        paint(picture, overlay);
        return inked(picture, 0, 200);
    };
    const int whole = shown({80, 40}, Across::left);
    ASSERT_GT(whole, 100);
    for (const Pixel at : {Pixel{190, 40}, Pixel{80, 8}, Pixel{195, 3}})
        EXPECT_NEAR(shown(at, Across::left), whole, 0.05 * whole) << at.x << ", " << at.y;
    EXPECT_NEAR(shown({10, 40}, Across::right), whole, 0.05 * whole);
    EXPECT_EQ(shown({230, 40}, Across::left), 0) << "it begins outside";
}

TEST(Text, ThatNoFontHasIsCalledByItsNumber)
{
    constexpr const char* kUnassigned = "\u0378";  // no character, so no font will have it
    EXPECT_EQ(written(kUnassigned).rgb, written("[U+0378]").rgb);
}

/// WCAG 2: of a picture's dimmest or brightest values, 0 to 255.
double contrast(double light, double dark)
{
    const auto luminance = [](double v) { return std::pow((v / 255 + 0.055) / 1.055, 2.4); };
    return (luminance(light) + 0.05) / (luminance(dark) + 0.05);
}

TEST(Text, StandsOutOnBrightTissueAndDimsNoMarkerBelowIt)
{
    constexpr int kWidth = 400, kHeight = 60;
    Picture picture(kWidth, kHeight, {255, 255, 255});
    Overlay overlay;
    overlay.texts.push_back({{20, 30}, "sea measures, no room", 14, {230, 230, 230}, Across::left, Along::middle, 1e9});
    overlay.texts.push_back(overlay.texts.back());  // two over each other darken once
    overlay.discs.push_back({{25, 30}, 12, {255, 48, 48}, 2});
    const double right = 20 + textSize(overlay.texts.back()).width_px;
    paint(picture, overlay);
    // Above letters without ascenders, where no rim reaches.
    for (int x = 45; x < int(right); ++x) {
        const int ground = picture.at(x, 25).green;
        EXPECT_GE(contrast(230, ground), 4.5) << x << ": " << ground;
        EXPECT_GT(ground, 80) << "what lies below is still seen";
    }
    EXPECT_EQ(picture.at(25, 18), (Rgb{255, 48, 48}));
    EXPECT_EQ(picture.at(25, 5), (Rgb{255, 255, 255}));
    EXPECT_EQ(picture.at(kWidth - 5, 30), (Rgb{255, 255, 255}));
}

TEST(Paint, LinesAndDiscsLieWhereTheyShould)
{
    const Rgb red{255, 0, 0}, blue{0, 0, 255};
    Picture picture(60, 40, {50, 50, 50});
    Overlay overlay;
    overlay.lines.push_back({{{10, 20.5}, {30, 20.5}}, red, 3, 0});
    overlay.discs.push_back({{45, 20}, 8, blue, 2});
    paint(picture, overlay);
    EXPECT_EQ(picture.at(20, 20), red);
    EXPECT_EQ(picture.at(20, 10), (Rgb{50, 50, 50}));
    EXPECT_EQ(picture.at(52, 20), blue);
    EXPECT_EQ(picture.at(45, 20), (Rgb{50, 50, 50}));  // the ring's middle stays free
    Overlay outside;
    outside.lines.push_back({{{-50, -50}, {-10, 200}}, red, 3, 4});
    outside.discs.push_back({{500, 500}, 8, blue, 0});
    outside.texts.push_back({{-30, 35}, "off the edge", 20, red, Across::left, Along::top, 1e9});
    paint(picture, outside);  // and is cut off
}

}  // namespace
}  // namespace vicon::viewer
