// Names and notes in every script: what is printed, in which order, and what cannot be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ft2build.h>
#include FT_FREETYPE_H

#include <map>
#include <stdexcept>

#include "pdf_document.h"
#include "report_samples.h"
#include "text.h"
#include "vicon/core/file.h"
#include "vicon/support/support.h"

namespace vicon::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Name {
    const char* script;
    const char* dicom;
    std::vector<std::string> printed;  ///< must be in the text of every page
};

class Names : public testing::TestWithParam<Name> {};

// The examples of the DICOM standard (PS3.5 annexes H to K) and of the character sets' test files.
INSTANTIATE_TEST_SUITE_P(
    Scripts, Names,
    testing::Values(
        Name{"Latin", "Äneas^Rüdiger", {"Äneas, Rüdiger"}}, Name{"French", "Buc^Jérôme", {"Buc, Jérôme"}},
        Name{"Polish", "Łącka^Żaneta", {"Łącka, Żaneta"}}, Name{"Vietnamese", "Nguyễn^Thị Bưởi", {"Nguyễn, Thị Bưởi"}},
        Name{"Decomposed", "Bue\u0301^Zoe\u0308", {"Bué, Zoë"}}, Name{"Greek", "Διονυσιος", {"Διονυσιος"}},
        Name{"Cyrillic", "Люкceмбypг", {"Люкceмбypг"}}, Name{"Hebrew", "שרון^דבורה", {"שרון", "דבורה"}},
        Name{"Arabic", "قباني^لنزار", {"قباني", "لنزار"}},
        Name{"ArabicLigature", "علاء^صلاح", {"ع\ufefcء", "ص\ufefcح"}},
        Name{"JapaneseKanji", "Yamada^Tarou=山田^太郎=やまだ^たろう", {"Yamada, Tarou", "山田 太郎", "やまだ たろう"}},
        Name{"JapaneseHalfWidth", "ﾔﾏﾀﾞ^ﾀﾛｳ=山田^太郎=やまだ^たろう", {"ﾔﾏﾀﾞ ﾀﾛｳ", "山田 太郎"}},
        Name{"Korean", "Hong^Gildong=洪^吉洞=홍^길동", {"Hong, Gildong", "洪 吉洞", "홍 길동"}},
        Name{"ChineseUtf8", "Wang^XiaoDong=王^小東", {"Wang, XiaoDong", "王 小東"}},
        Name{"ChineseGb18030", "Wang^XiaoDong=王^小东", {"王 小东"}},
        Name{"ChineseGbk", "Zhang^XiaoDong=张^小东", {"Zhang, XiaoDong", "张 小东"}},
        Name{"Thai", "นามสกุล^ชื่อ", {"นามสกุล", "ชื่อ"}}),
    [](const auto& info) { return info.param.script; });

TEST_P(Names, ArePrintedAndCanBeReadBack)
{
    const support::TemporaryFolder folder;
    ReportContent content = samples::plainCase(folder.path());
    content.a_case.patient.name = GetParam().dicom;
    content.markers = {samples::plainMarker(folder.path(), 1), samples::plainMarker(folder.path(), 2)};
    content.markers[0].marker.note = GetParam().dicom;
    const PdfResult result = writePdf(content, folder / "report.pdf", {});
    EXPECT_THAT(result.warnings, IsEmpty());
    const std::vector<std::string> pages = samples::pageTexts(folder / "report.pdf");
    ASSERT_EQ(int(pages.size()), result.pages);
    for (const std::string& page : pages)
        for (const std::string& printed : GetParam().printed)
            EXPECT_THAT(page, HasSubstr(printed));
    const auto fonts = support::runCommand("pdffonts " + (folder / "report.pdf").string() + " | grep -c ' no '");
    EXPECT_EQ(fonts.output, "0\n");
}

class Typesetting : public testing::Test {
protected:
    FontSet fonts_{ReportOptions{}.font_folder};
    Typesetter type_{fonts_};

    /// The glyphs' codes from left to right.
    std::u16string visual(const std::string& text)
    {
        std::u16string out;
        for (const TextRun& run : type_.line(text, {}).runs)
            out += run.codes;
        return out;
    }
};

TEST_F(Typesetting, RightToLeftTextStandsInVisualOrder)
{
    EXPECT_EQ(visual("שרון"), u"ןורש");
    EXPECT_EQ(visual("שרון 12 מ"), u"מ 12 ןורש");
    EXPECT_EQ(visual("Sharon (שרון, דנה) 7"), u"Sharon (הנד ,ןורש) 7");
    EXPECT_EQ(visual("(שרון)"), u"(ןורש)");
}

TEST_F(Typesetting, ArabicLettersAreJoined)
{
    // qaf initial, beh medial, alef final; noon initial, yeh final: from right to left.
    EXPECT_EQ(visual("قباني"), u"\ufef2\ufee7\ufe8e\ufe92\ufed7");
    // Lam and alef make one glyph.
    EXPECT_EQ(visual("لا"), u"\ufefb");
}

TEST_F(Typesetting, DirectionOverridesCannotTurnAName)
{
    EXPECT_EQ(visual("Adams\u202eecila\u202c"), u"Adamsecila");
}

TEST_F(Typesetting, WhatNoFontHasBecomesItsCodePointAndIsReported)
{
    EXPECT_EQ(visual("a\U0001F600b"), u"a[U+1F600]b");
    EXPECT_EQ(visual("न"), u"[U+0928]");  // an unshaped script would be misspelt
    EXPECT_EQ(visual("\ue000"), u"[U+E000]");
    EXPECT_EQ(visual("\x80"), u"[U+FFFD]");
    EXPECT_THAT(type_.missing(), ElementsAre(U'न', U'\ue000', Typesetter::kInvalidUtf8, U'\U0001F600'));
}

TEST_F(Typesetting, ControlAndInvisibleCharactersDrawNothing)
{
    EXPECT_EQ(visual("a\tb\u200bc\ufeffd\x01"
                     "e"),
              u"a bcd e");
    EXPECT_THAT(type_.missing(), IsEmpty());
    EXPECT_EQ(type_.lines("one\r\ntwo\n\nfour", {}, 100).size(), 4U);
    EXPECT_EQ(type_.lines("", {}, 100).size(), 1U);
}

TEST_F(Typesetting, LinesFitTheirWidthAndLoseNothing)
{
    const std::string text =
        "Nothing is lost when a_rather_long_word_that_fits_nowhere is broken. 山田太郎が検査を受けた。";
    for (const double width : {10.0, 25.0, 60.0, 200.0}) {
        std::u16string all;
        for (const TextLine& line : type_.lines(text, {.size = 9}, width)) {
            EXPECT_LE(line.width, width + 1e-9);
            for (const TextRun& run : line.runs)
                all += run.codes;
        }
        std::erase(all, u' ');
        std::u16string expected = visual(text);
        std::erase(expected, u' ');
        EXPECT_EQ(all, expected) << width;
    }
}

TEST_F(Typesetting, HanCharactersTakeTheirFormFromTheText)
{
    const auto file = [&](const std::string& text) {
        return fonts_.file(type_.line(text, {}).runs.back().font).filename().string();
    };
    EXPECT_EQ(file("直"), "wqy-zenhei.ttc");
    EXPECT_EQ(file("の直"), "ipag.ttf");
}

TEST(Warnings, NameTheCharacterAndNotThePatient)
{
    const support::TemporaryFolder folder;
    ReportContent content = samples::plainCase(folder.path());
    content.a_case.patient.name = "Secret^Smile \U0001F600";
    const PdfResult result = writePdf(content, folder / "report.pdf", {});
    EXPECT_THAT(result.warnings, ElementsAre("no font can show U+1F600; it is printed as [U+1F600]"));
    EXPECT_THAT(samples::textOf(folder / "report.pdf"), HasSubstr("Secret, Smile [U+1F600]"));
}

constexpr int kCell = 28, kColumns = 20, kDpi = 144;  // points
constexpr double kSize = 18;
/// Of a glyph's ink, for the renderers' different treatment of edges; and so many pixels.
constexpr double kInkTolerance = 0.12, kInkFloor = 6;

/// The ink of a glyph as its font has it, in pixels of the rendered page.
class FontInk {
public:
    FontInk() { FT_Init_FreeType(&library_); }
    ~FontInk() { FT_Done_FreeType(library_); }
    FontInk(const FontInk&) = delete;
    FontInk& operator=(const FontInk&) = delete;

    double of(const std::filesystem::path& file, char32_t c)
    {
        FT_Face& face = faces_[file];
        if (!face && FT_New_Face(library_, file.c_str(), 0, &face) != 0)
            throw std::runtime_error("cannot load " + file.string());
        constexpr unsigned kFine = 144;  // pixels an em
        FT_Set_Pixel_Sizes(face, kFine, kFine);
        FT_Load_Char(face, c, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP);
        FT_Render_Glyph(face->glyph, FT_RENDER_MODE_NORMAL);
        const FT_Bitmap& bitmap = face->glyph->bitmap;
        double ink = 0;
        for (unsigned y = 0; y < bitmap.rows; ++y)
            for (unsigned x = 0; x < bitmap.width; ++x)
                ink += bitmap.buffer[y * unsigned(bitmap.pitch) + x] / 255.0;
        const double scale = kSize * kDpi / 72 / kFine;
        return ink * scale * scale;
    }

private:
    FT_Library library_ = nullptr;
    std::map<std::filesystem::path, FT_Face> faces_;  // go with the library
};

double inkIn(const samples::Raster& page, std::size_t cell)
{
    constexpr int kPixels = kCell * kDpi / 72;
    const int left = int(cell % kColumns) * kPixels, top = int(cell / kColumns) * kPixels;
    double ink = 0;
    for (int y = top; y < top + kPixels; ++y)
        for (int x = left; x < left + kPixels; ++x)
            ink += 1 - page.at(x, y)[1] / 255.0;
    return ink;
}

/// Has poppler render each character, and holds its ink against the font's own outline: a glyph that was embedded
/// without its parts has less, one of another character more or less.
void expectWhole(const FontSet& fonts, const std::vector<char32_t>& characters)
{
    const support::TemporaryFolder folder;
    const std::size_t rows = (characters.size() + kColumns - 1) / kColumns;
    PdfDocument pdf(fonts, {});
    pdf.addPage(kCell * kColumns, double(kCell * rows));
    for (std::size_t n = 0; n < characters.size(); ++n) {
        const TextRun run{*fonts.find(characters[n], {}), {char16_t(characters[n])}, 0};
        pdf.text(0, double(n % kColumns) * kCell + 4, kCell * double(rows - n / kColumns - 1) + 8,
                 {.runs = {run}, .width = 0, .size = kSize}, {});
    }
    replaceFile(folder / "all.pdf", pdf.finish());
    const samples::Raster page = samples::render(folder / "all.pdf", 1, kDpi);
    FontInk font_ink;
    for (std::size_t n = 0; n < characters.size(); ++n) {
        const double expected = font_ink.of(fonts.file(*fonts.find(characters[n], {})), characters[n]);
        EXPECT_NEAR(inkIn(page, n), expected, kInkTolerance * expected + kInkFloor)
            << std::hex << "U+" << unsigned(characters[n]);
    }
}

class Ink : public Typesetting, public testing::WithParamInterface<std::pair<char32_t, char32_t>> {};

INSTANTIATE_TEST_SUITE_P(Blocks, Ink,
                         testing::Values(std::pair{U'!', U'~'}, std::pair{U'\u00a1', U'\u017f'},
                                         std::pair{U'\u0386', U'\u03ce'}, std::pair{U'\u0401', U'\u045f'},
                                         std::pair{U'\u05d0', U'\u05ea'}, std::pair{U'\u1ea0', U'\u1ef9'},
                                         std::pair{U'\ufe80', U'\ufefc'}, std::pair{U'\u0e01', U'\u0e2f'},
                                         std::pair{U'\u3041', U'\u30fe'}, std::pair{U'\uac00', U'\uac7f'},
                                         std::pair{U'\u4e00', U'\u4e8f'}));

TEST_P(Ink, EveryGlyphIsDrawnWhole)
{
    std::vector<char32_t> characters;
    for (char32_t c = GetParam().first; c <= GetParam().second; ++c)
        if (c != 0xad && fonts_.find(c, {}))  // the soft hyphen is invisible
            characters.push_back(c);
    ASSERT_GT(characters.size(), 20U);
    expectWhole(fonts_, characters);
}

TEST_F(Typesetting, AGlyphMadeOfGlyphsIsWholeWithoutOthersThatBringItsParts)
{
    for (const char32_t c : {U'\ufee5', U'\ufef5', U'\u1ec7', U'\u00c5', U'\u0390', U'\u045c'})
        expectWhole(fonts_, {c});
}

}  // namespace
}  // namespace vicon::report
