#include "vicon/text/typesetter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vicon/text/glyph.h"

namespace vicon::text {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr const char* kFolder = "/usr/share/fonts";
constexpr char32_t kShaped = 0xfffc;

struct Typesetting : testing::Test {
    FontSet fonts{{kFolder}, FontSet::Medium::paper};
    Typesetter type{fonts};

    /// Characters whose own glyphs stand in the line, from left to right; kShaped for what shaping made.
    static std::u32string visual(const TextLine& line)
    {
        std::u32string out;
        for (const GlyphRun& run : line.runs)
            for (const PlacedGlyph& glyph : run.glyphs)
                out += glyph.character ? glyph.character : kShaped;
        return out;
    }
    std::u32string visual(const std::string& text) { return visual(type.line(text, {})); }
    std::vector<unsigned> glyphs(const std::string& text)
    {
        std::vector<unsigned> out;
        for (const GlyphRun& run : type.line(text, {}).runs)
            for (const PlacedGlyph& glyph : run.glyphs)
                out.push_back(glyph.glyph);
        return out;
    }
    double width(const std::string& text) { return type.line(text, {.size = 24}).width; }
    std::string lastFile(const std::string& text)
    {
        return fonts.file(type.line(text, {}).runs.back().font).filename().string();
    }
};

TEST_F(Typesetting, RightToLeftTextStandsInVisualOrder)
{
    EXPECT_EQ(visual("שרון"), U"ןורש");
    EXPECT_EQ(visual("שרון 12 מ"), U"מ 12 ןורש");
    EXPECT_EQ(visual("Sharon (שרון, דנה) 7"), U"Sharon (הנד ,ןורש) 7");
    EXPECT_EQ(visual("(שרון)"), U"(ןורש)");
    EXPECT_TRUE(type.line("שרון Sharon", {}).right_to_left);
    EXPECT_FALSE(type.line("Sharon שרון", {}).right_to_left);
}

TEST_F(Typesetting, ArabicLettersAreJoined)
{
    const auto joined = glyphs("قباني"), apart = glyphs("ق\u200cب\u200cا\u200cن\u200cي");
    ASSERT_EQ(joined.size(), 5U);
    for (const unsigned glyph : joined)
        EXPECT_EQ(std::count(apart.begin(), apart.end(), glyph), 0) << glyph;
    const TextLine lam_alef = type.line("لا", {});
    ASSERT_EQ(lam_alef.runs.size(), 1U);
    EXPECT_EQ(lam_alef.runs[0].glyphs.size(), 1U);
    EXPECT_EQ(lam_alef.runs[0].text, U"لا");
    EXPECT_EQ(visual(lam_alef), std::u32string(1, kShaped));
}

TEST_F(Typesetting, LettersStackReorderAndTakeMarks)
{
    EXPECT_LT(width("क्ष"), 0.8 * width("क्\u200cष")) << "Devanagari: one below the other";
    EXPECT_LT(width("క్ష"), 0.8 * width("క్\u200cష")) << "Telugu";
    const std::vector<unsigned> ki = glyphs("कि"), ka = glyphs("क");
    ASSERT_EQ(ki.size(), 2U);
    EXPECT_EQ(ki[1], ka[0]) << "the vowel is written after its consonant and stands before it";
    EXPECT_NEAR(width("ก\u0e49"), width("ก"), 0.1) << "Thai: a tone takes no room";
    EXPECT_NEAR(width("م\u064e"), width("م"), 0.1) << "nor does an Arabic vowel";
    EXPECT_EQ(visual("e\u0301"), U"é");
}

TEST_F(Typesetting, AWordIsOfOneFontThatHasAllOfIt)
{
    // Another font than Tamil's has one letter of each name, and comes before it by path.
    for (const char* name : {"சுப்பிரமணியம்", "பாரதி"}) {
        const TextLine line = type.line(name, {});
        ASSERT_EQ(line.runs.size(), 1U) << name;
        EXPECT_EQ(lastFile(name), "NotoSansTamil-Regular.ttf");
    }
}

TEST_F(Typesetting, IsTheSameForPicturesAndPaper)
{
    FontSet screen_fonts{{kFolder}, FontSet::Medium::screen};
    Typesetter screen{screen_fonts};
    constexpr double kSize = 40;
    for (const char* name : {"अनुष्का शर्मा", "వెంకటేశ్వర్లు", "น้ำผึ้ง", "やまだ 太郎", "王 小東", "홍 길동"}) {
        SCOPED_TRACE(name);
        const TextLine picture = screen.line(name, {.size = kSize}), paper = type.line(name, {.size = kSize});
        std::vector<const GlyphRun*> runs;  // without those that are spaces
        const auto words = [](const TextLine& line) {
            std::vector<GlyphRun> out;
            std::copy_if(line.runs.begin(), line.runs.end(), std::back_inserter(out),
                         [](const GlyphRun& run) { return run.text != U" "; });
            return out;
        };
        const auto a = words(picture), b = words(paper);
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t n = 0; n < a.size(); ++n) {
            EXPECT_EQ(screen_fonts.file(a[n].font), fonts.file(b[n].font));
            ASSERT_EQ(a[n].glyphs.size(), b[n].glyphs.size());
            for (std::size_t g = 0; g < a[n].glyphs.size(); ++g) {
                EXPECT_EQ(a[n].glyphs[g].glyph, b[n].glyphs[g].glyph);
                EXPECT_NEAR(a[n].glyphs[g].x - a[n].glyphs[0].x, b[n].glyphs[g].x - b[n].glyphs[0].x, 0.5);
                EXPECT_NEAR(a[n].glyphs[g].y, b[n].glyphs[g].y, 0.1);
            }
        }
    }
}

TEST_F(Typesetting, DirectionOverridesCannotTurnAName)
{
    EXPECT_EQ(visual("Adams\u202eecila\u202c"), U"Adamsecila");
}

TEST_F(Typesetting, WhatNoFontHasBecomesItsCodePointAndIsReported)
{
    EXPECT_EQ(visual("a\u0378"
                     "b"),
              U"a[U+0378]b");
    EXPECT_EQ(visual("\ue000"), U"[U+E000]") << "a private character, whatever a font draws for it";
    EXPECT_EQ(visual("\U000F0000"), U"[U+F0000]");
    EXPECT_EQ(visual("\x80"), U"[U+FFFD]");
    EXPECT_THAT(type.missing(), ElementsAre(U'\u0378', U'\ue000', Typesetter::kInvalidUtf8, U'\U000F0000'));
}

TEST_F(Typesetting, ControlAndInvisibleCharactersDrawNothing)
{
    EXPECT_EQ(visual("a\tb\u200bc\ufeffd\x01"
                     "e"),
              U"a bcd e");
    EXPECT_THAT(type.missing(), IsEmpty());
    EXPECT_EQ(type.lines("one\r\ntwo\n\nfour", {}, 100).size(), 4U);
    EXPECT_EQ(visual("one\r\ntwo"), U"one two");
    EXPECT_EQ(type.lines("", {}, 100).size(), 1U);
    EXPECT_THAT(type.line("", {}).runs, IsEmpty());
}

TEST_F(Typesetting, LinesFitTheirWidthAndLoseNothing)
{
    const std::string text =
        "Nothing is lost when a_rather_long_word_that_fits_nowhere is broken. 山田太郎が検査を受けた。 "
        "Немного текста с кернингом: ГОСТ, Тула.";
    for (const double width : {10.0, 25.0, 60.0, 200.0}) {
        std::u32string all;
        for (const TextLine& line : type.lines(text, {.size = 9}, width)) {
            EXPECT_LE(line.width, width + 1e-9);
            all += visual(line);
        }
        std::erase(all, U' ');
        std::u32string expected = visual(text);
        std::erase(expected, U' ');
        EXPECT_EQ(all, expected) << width;
    }
}

TEST_F(Typesetting, LinesBreakWhereTheLanguageAllows)
{
    const auto words = [&](const std::string& text) {
        std::vector<std::u32string> out;
        for (const TextLine& line : type.lines(text, {.size = 9}, 1e-3 + width("นามสกุล") * 9 / 24)) {
            out.emplace_back();
            for (const GlyphRun& run : line.runs)
                out.back() += run.text;
        }
        return out;
    };
    // Thai has no spaces between words; a word's marks stay with their letters.
    EXPECT_THAT(words("นามสกุลนามสกุล"), ElementsAre(U"นามสกุล", U"นามสกุล"));
}

TEST_F(Typesetting, HanCharactersTakeTheirFormFromTheText)
{
    EXPECT_EQ(lastFile("直"), "wqy-zenhei.ttc");
    EXPECT_EQ(lastFile("の直"), "ipag.ttf");
    // A form that only a name insists on is not exchanged for the common one, as NFC would.
    EXPECT_EQ(type.line("\ufa19", {}).runs.front().text, U"\ufa19");
}

TEST_F(Typesetting, BoldTextIsBoldInEveryScriptThatHasIt)
{
    for (const char* name : {"Adams", "שרון", "अनुष्का", "นามสกุล", "قباني"})
        EXPECT_THAT(fonts.file(type.line(name, {.bold = true}).runs.front().font).filename().string(),
                    testing::EndsWith("-Bold.ttf"))
            << name;
}

TEST_F(Typesetting, ALineThatIsAppendedStandsToTheRight)
{
    TextLine line = type.line("ab", {});
    line.append(type.line("…", {}));
    EXPECT_EQ(visual(line), U"ab…");
    EXPECT_DOUBLE_EQ(line.width, type.line("ab", {}).width + type.line("…", {}).width);
    EXPECT_DOUBLE_EQ(line.runs.back().glyphs.back().x, type.line("ab", {}).width);
}

TEST(Fonts, AreNoneInAnEmptyFolder)
{
    FontSet none({"/nonexistent"}, FontSet::Medium::screen);
    EXPECT_FALSE(none.find(U'A'));
}

}  // namespace
}  // namespace vicon::text
