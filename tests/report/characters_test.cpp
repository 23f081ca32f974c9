// Names and notes in every script: what is printed, in which order, and what cannot be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "pdf_document.h"
#include "report_samples.h"
#include "vicon/core/file.h"
#include "vicon/support/support.h"
#include "vicon/text/glyph.h"

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
        Name{"Arabic", "قباني^لنزار", {"قباني", "لنزار"}}, Name{"ArabicLigature", "علاء^صلاح", {"علاء", "صلاح"}},
        Name{"ArabicMarks", "مُحَمَّد^زَيْن", {"مُحَمَّد", "زَيْن"}},
        Name{"Persian", "کوه\u200cپیما^رضا", {"کوه\u200cپیما", "رضا"}},
        Name{"HebrewPoints", "שָׁלוֹם^דָּנָה", {"שָׁלוֹם", "דָּנָה"}}, Name{"Devanagari", "शर्मा^अनुष्का", {"शर्मा", "अनुष्का"}},
        Name{"Telugu", "వెంకటేశ్వర్లు^శ్రీనివాస్", {"వెంకటేశ్వర్లు", "శ్రీనివాస్"}},
        Name{"Tamil", "சுப்பிரமணியம்^லட்சுமி", {"சுப்பிரமணியம்", "லட்சுமி"}},
        Name{"Bengali", "চট্টোপাধ্যায়^কৃষ্ণ", {"চট্টোপাধ্যায়", "কৃষ্ণ"}}, Name{"Khmer", "សុខ^ចន្ទ្រា", {"សុខ", "ចន្ទ្រា"}},
        Name{"BeyondTheBasicPlane", "\U00010400\U00010428^\U0001D49C", {"\U00010400\U00010428"}},
        Name{"JapaneseKanji", "Yamada^Tarou=山田^太郎=やまだ^たろう", {"Yamada, Tarou", "山田 太郎", "やまだ たろう"}},
        Name{"JapaneseHalfWidth", "ﾔﾏﾀﾞ^ﾀﾛｳ=山田^太郎=やまだ^たろう", {"ﾔﾏﾀﾞ ﾀﾛｳ", "山田 太郎"}},
        Name{"Korean", "Hong^Gildong=洪^吉洞=홍^길동", {"Hong, Gildong", "洪 吉洞", "홍 길동"}},
        Name{"ChineseUtf8", "Wang^XiaoDong=王^小東", {"Wang, XiaoDong", "王 小東"}},
        Name{"ChineseGb18030", "Wang^XiaoDong=王^小东", {"王 小东"}},
        Name{"ChineseGbk", "Zhang^XiaoDong=张^小东", {"Zhang, XiaoDong", "张 小东"}},
        Name{"Thai", "นามสกุล^ชื่อ", {"นามสกุล", "ชื่อ"}}, Name{"ThaiTones", "น้ำผึ้ง^ปี่", {"น้ำผึ้ง", "ปี่"}}),
    [](const auto& info) { return info.param.script; });

TEST_P(Names, ArePrintedAndCanBeReadBack)
{
    const support::TemporaryFolder folder;
    ReportContent content = samples::plainCase(folder.path());
    content.read.record.patient.name = GetParam().dicom;
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

TEST(Warnings, NameTheCharacterAndNotThePatient)
{
    const support::TemporaryFolder folder;
    ReportContent content = samples::plainCase(folder.path());
    content.read.record.patient.name = "Secret^Smile \ue123";
    const PdfResult result = writePdf(content, folder / "report.pdf", {});
    EXPECT_THAT(result.warnings, ElementsAre("no font can show U+E123; it is printed as [U+E123]"));
    EXPECT_THAT(samples::textOf(folder / "report.pdf"), HasSubstr("Secret, Smile [U+E123]"));
}

constexpr int kCell = 28, kColumns = 20, kDpi = 144;  // points
constexpr double kSize = 18;
/// Of a glyph's ink, for the renderers' different treatment of edges; and so many pixels.
constexpr double kInkTolerance = 0.12, kInkFloor = 6;

class Ink : public testing::Test {
protected:
    text::FontSet fonts_{{ReportOptions{}.font_folder}, text::FontSet::Medium::paper};
    Typesetter type_{fonts_};

    /// The ink of a glyph as its font has it, in pixels of the rendered page.
    double inkOf(int font, unsigned glyph) const
    {
        constexpr double kFine = 144;  // pixels an em
        const text::GlyphMask drawn = glyphMaskOf(fonts_, font, glyph, kFine, 0, 0);
        const double scale = kSize * kDpi / 72 / kFine;
        return std::accumulate(drawn.cover.begin(), drawn.cover.end(), 0.0) / 255 * scale * scale;
    }
    void expectWhole(const std::vector<char32_t>& characters);
    void expectDrawn(const std::string& word);
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

/// The character's own glyph, unshaped.
TextLine ownGlyph(text::FontSet& fonts, char32_t c)
{
    const int font = fonts.find(c).value();
    return {{{font, false, {c}, {{glyphOf(fonts, font, c), 0, 0, 0, 0, 0, c}}}}, 0, kSize, false};
}

/// Has poppler render each character, and holds its ink against the font's own outline: a glyph that was embedded
/// without its parts has less, one of another character more or less.
void Ink::expectWhole(const std::vector<char32_t>& characters)
{
    const support::TemporaryFolder folder;
    const std::size_t rows = (characters.size() + kColumns - 1) / kColumns;
    PdfDocument pdf(fonts_, {});
    pdf.addPage(kCell * kColumns, double(kCell * rows));
    for (std::size_t n = 0; n < characters.size(); ++n)
        pdf.text(0, double(n % kColumns) * kCell + 4, kCell * double(rows - n / kColumns - 1) + 8,
                 ownGlyph(fonts_, characters[n]), {});
    replaceFile(folder / "all.pdf", pdf.finish());
    const samples::Raster page = samples::render(folder / "all.pdf", 1, kDpi);
    for (std::size_t n = 0; n < characters.size(); ++n) {
        const text::GlyphRun run = ownGlyph(fonts_, characters[n]).runs[0];
        const double expected = inkOf(run.font, run.glyphs[0].glyph);
        EXPECT_NEAR(inkIn(page, n), expected, kInkTolerance * expected + kInkFloor)
            << std::hex << "U+" << unsigned(characters[n]);
    }
}

/// Has poppler render a word, and holds it pixel by pixel against its shaped glyphs.
void Ink::expectDrawn(const std::string& word)
{
    SCOPED_TRACE(word);
    constexpr double kLarge = 36, kPixels = kDpi / 72.0;
    constexpr int kLeft = 10, kHeight = 72, kBase = 24;  // points
    const support::TemporaryFolder folder;
    const TextLine line = type_.line(word, {.size = kLarge});
    PdfDocument pdf(fonts_, {});
    pdf.addPage(std::ceil(line.width) + 2 * kLeft, kHeight);
    pdf.text(0, kLeft, kBase, line, {});
    replaceFile(folder / "word.pdf", pdf.finish());
    const samples::Raster page = samples::render(folder / "word.pdf", 1, kDpi);
    std::vector<double> expected(page.rgb.size() / 3, 0);
    for (const text::GlyphRun& run : line.runs)
        for (const text::PlacedGlyph& glyph : run.glyphs) {
            const double x = (kLeft + glyph.x) * kPixels, y = (kHeight - kBase - glyph.y) * kPixels;
            const double down = std::ceil(y);
            const text::GlyphMask drawn =
                glyphMaskOf(fonts_, run.font, glyph.glyph, kLarge * kPixels, x - std::floor(x), down - y);
            for (int n = 0; n < drawn.width * drawn.height; ++n) {
                const int column = int(std::floor(x)) + drawn.left + n % drawn.width;
                const int row = int(down) - drawn.top + n / drawn.width;
                double& there = expected.at(std::size_t(row) * std::size_t(page.width) + std::size_t(column));
                there = std::max(there, drawn.cover[std::size_t(n)] / 255.0);
            }
        }
    double ink = 0, wrong = 0;
    for (std::size_t n = 0; n < expected.size(); ++n) {
        ink += expected[n];
        wrong += std::abs(expected[n] - (1 - page.rgb[3 * n + 1] / 255.0));
    }
    EXPECT_GT(ink, 200);
    EXPECT_LT(wrong, kInkTolerance * ink);
}

TEST_F(Ink, OfShapedWordsLiesWhereTheirGlyphsAre)
{
    for (const char* word : {"शर्मा", "వెంకటేశ్వర్లు", "ชื่อน้ำผึ้ง", "مُحَمَّد", "علاء", "שָׁלוֹם", "সৃষ্টি", "Adams", "山田"})
        expectDrawn(word);
}

class InkOfBlock : public Ink, public testing::WithParamInterface<std::pair<char32_t, char32_t>> {};

INSTANTIATE_TEST_SUITE_P(Blocks, InkOfBlock,
                         testing::Values(std::pair{U'!', U'~'}, std::pair{U'\u00a1', U'\u017f'},
                                         std::pair{U'\u0386', U'\u03ce'}, std::pair{U'\u0401', U'\u045f'},
                                         std::pair{U'\u05d0', U'\u05ea'}, std::pair{U'\u1ea0', U'\u1ef9'},
                                         std::pair{U'\ufe80', U'\ufefc'}, std::pair{U'\u0e01', U'\u0e2f'},
                                         std::pair{U'\u3041', U'\u30fe'}, std::pair{U'\uac00', U'\uac7f'},
                                         std::pair{U'\u4e00', U'\u4e8f'}));

TEST_P(InkOfBlock, EveryGlyphIsDrawnWhole)
{
    std::vector<char32_t> characters;
    for (char32_t c = GetParam().first; c <= GetParam().second; ++c)
        if (c != 0xad && fonts_.find(c))  // the soft hyphen is invisible
            characters.push_back(c);
    ASSERT_GT(characters.size(), 20U);
    expectWhole(characters);
}

TEST_F(Ink, OfAGlyphMadeOfGlyphsIsWholeWithoutOthersThatBringItsParts)
{
    for (const char32_t c : {U'\ufee5', U'\ufef5', U'\u1ec7', U'\u00c5', U'\u0390', U'\u045c'})
        expectWhole({c});
}

TEST_F(Ink, OfAFontThatLibharuCannotLoadIsDrawnAndItsTextKept)
{
    // FreeType does without the table of names, libharu does not.
    const support::TemporaryFolder folder;
    const auto fileOf = [&](char32_t c) { return fonts_.file(fonts_.find(c).value()); };
    std::string font = readFile(fileOf(U'ש'));
    font.replace(font.find("name"), 4, "none");
    replaceFile(folder / fileOf(U'ש').filename(), font);
    std::filesystem::copy_file(fileOf(U'A'), folder / fileOf(U'A').filename());

    text::FontSet fonts({folder.path()}, text::FontSet::Medium::paper);
    PdfDocument pdf(fonts, {});
    pdf.addPage(300, 100);
    pdf.text(0, 10, 50, Typesetter(fonts).line("Adams שרון", {.size = kSize}), {});
    replaceFile(folder / "drawn.pdf", pdf.finish());
    EXPECT_THAT(samples::textOf(folder / "drawn.pdf"), testing::AllOf(HasSubstr("Adams"), HasSubstr("שרון")));
    const samples::Raster page = samples::render(folder / "drawn.pdf", 1, kDpi);
    double ink = 0;
    for (std::size_t n = 0; n < page.rgb.size(); n += 3)
        ink += 1 - page.rgb[n] / 255.0;
    double expected = 0;
    for (const text::GlyphRun& run : type_.line("Adams שרון", {.size = kSize}).runs)
        for (const text::PlacedGlyph& glyph : run.glyphs)
            expected += inkOf(run.font, glyph.glyph);
    EXPECT_NEAR(ink, expected, kInkTolerance * expected);
}

TEST_F(Ink, OfLettersThatTheirFontHasIsText)
{
    const support::TemporaryFolder folder;
    PdfDocument pdf(fonts_, {});
    pdf.addPage(300, 100);
    pdf.text(0, 10, 50, type_.line("Adams Люкceмбypг Διονυσιος שרון 山田 홍", {}), {});
    replaceFile(folder / "text.pdf", pdf.finish());
    // Uncompressed, the page has no path that is filled.
    const auto content = support::runCommand("qpdf --qdf --object-streams=disable " + (folder / "text.pdf").string() +
                                             " - | grep -cE '^[0-9. -]+ (c|l|m)$'");
    EXPECT_EQ(content.output, "0\n");
}

}  // namespace
}  // namespace vicon::report
