#include "pdf_text.h"

#include <algorithm>
#include <cmath>

#include "pdf_objects.h"
#include "vicon/text/glyph.h"

namespace vicon::report {
namespace {

using text::PlacedGlyph;

constexpr double kKern = 2e-3;  ///< of the size: letters this far from their place are put there anew
/// Codes of invisible characters: private ones, which stand for nothing that is printed.
constexpr char16_t kFirstHidden = 0xe000, kLastHidden = 0xf8ff;
constexpr double kLeastStretch_percent = 10, kMostStretch_percent = 300;  // libharu's limits

/// UTF-8, as libharu takes text.
void append(std::string& utf8, char16_t c)
{
    if (c < 0x80) {
        utf8 += char(c);
        return;
    }
    if (c < 0x800) {
        utf8 += char(0xc0 | c >> 6);
    } else {
        utf8 += char(0xe0 | c >> 12);
        utf8 += char(0x80 | (c >> 6 & 0x3f));
    }
    utf8 += char(0x80 | (c & 0x3f));
}

bool isSpace(const text::GlyphRun& run, const PlacedGlyph& glyph)
{
    return run.text[glyph.cluster] == U' ';
}

/// The characters that the glyphs [from, to) stand for, from left to right.
std::u32string visualText(const text::GlyphRun& run, std::size_t from, std::size_t to)
{
    std::size_t first = run.text.size(), last = 0;
    for (std::size_t n = from; n < to; ++n) {
        first = std::min(first, run.glyphs[n].cluster);
        last = std::max(last, run.glyphs[n].cluster);
    }
    std::size_t end = run.text.size();
    for (const PlacedGlyph& glyph : run.glyphs)
        if (glyph.cluster > last)
            end = std::min(end, glyph.cluster);
    std::u32string out = run.text.substr(first, end - first);
    if (run.right_to_left)
        std::reverse(out.begin(), out.end());
    return out;
}

}  // namespace

void PdfText::write(HPDF_Page page, double x, double y, const text::TextLine& line)
{
    for (const text::GlyphRun& run : line.runs) {
        std::size_t from = 0;  // of what is text
        for (std::size_t word = 0; word < run.glyphs.size();) {
            std::size_t end = word;
            bool carried = true;
            for (; end < run.glyphs.size() && (end == word || !isSpace(run, run.glyphs[end])); ++end)
                carried = carried && isCarried(run, run.glyphs[end]);
            if (!carried) {
                writeText(page, {run, from, word, x, y, line.size});
                drawOutlines(page, {run, word, end, x, y, line.size});
                writeInvisibly(page, {run, word, end, x, y, line.size});
                from = end;
            }
            word = end;
        }
        writeText(page, {run, from, run.glyphs.size(), x, y, line.size});
    }
    haru_.check();
}

void PdfText::finish()
{
    for (auto& [number, used] : loaded_)
        if (used.font)
            setToUnicode(used.font, used.meaning);
}

PdfText::UsedFont& PdfText::load(int font)
{
    const auto [at, is_new] = loaded_.try_emplace(font);
    if (is_new) {
        const std::string file = fonts_.file(font).string();
        const char* name = file.ends_with(".ttc")
                               ? HPDF_LoadTTFontFromFile2(haru_.document(), file.c_str(), 0, HPDF_TRUE)
                               : HPDF_LoadTTFontFromFile(haru_.document(), file.c_str(), HPDF_TRUE);
        HPDF_Font loaded = name ? HPDF_GetFont(haru_.document(), name, "UTF-8") : nullptr;
        if (haru_.succeeded())
            at->second.font = loaded;
        haru_.check();
    }
    return at->second;
}

bool PdfText::isCarried(const text::GlyphRun& run, const PlacedGlyph& glyph)
{
    constexpr char32_t kLastOfBasicPlane = 0xffff;  // libharu's text is UCS-2
    return glyph.character != 0 && glyph.character <= kLastOfBasicPlane && load(run.font).font;
}

void PdfText::writeText(HPDF_Page page, const Word& word)
{
    const text::GlyphRun& run = word.run;
    for (std::size_t from = word.from, n = from; from < word.to; from = n) {
        UsedFont& used = load(run.font);
        std::string utf8;
        double next_x = run.glyphs[from].x;
        for (; n < word.to && std::abs(run.glyphs[n].x - next_x) < kKern * word.size; ++n) {
            const PlacedGlyph& glyph = run.glyphs[n];
            if (used.meaning.try_emplace(char16_t(glyph.character), glyph.character).second)
                embedGlyphs(used.font, componentsOf(fonts_, run.font, glyph.glyph));
            append(utf8, char16_t(glyph.character));
            next_x = glyph.x + word.size * advance_em(fonts_, run.font, glyph.glyph);
        }
        HPDF_Page_SetFontAndSize(page, used.font, float(word.size));
        HPDF_Page_BeginText(page);
        HPDF_Page_TextOut(page, float(word.x + run.glyphs[from].x), float(word.y + run.glyphs[from].y), utf8.c_str());
        HPDF_Page_EndText(page);
    }
}

void PdfText::drawOutlines(HPDF_Page page, const Word& word) const
{
    bool drawn = false;
    for (std::size_t n = word.from; n < word.to; ++n) {
        const PlacedGlyph& glyph = word.run.glyphs[n];
        const auto x = [&](const text::OutlinePart::Point& p) { return float(word.x + glyph.x + word.size * p.x); };
        const auto y = [&](const text::OutlinePart::Point& p) { return float(word.y + glyph.y + word.size * p.y); };
        for (const auto& [kind, p] : outlineOf(fonts_, word.run.font, glyph.glyph)) {
            if (kind == text::OutlinePart::Kind::move)
                HPDF_Page_MoveTo(page, x(p[2]), y(p[2]));
            else if (kind == text::OutlinePart::Kind::line)
                HPDF_Page_LineTo(page, x(p[2]), y(p[2]));
            else
                HPDF_Page_CurveTo(page, x(p[0]), y(p[0]), x(p[1]), y(p[1]), x(p[2]), y(p[2]));
            drawn = true;
        }
    }
    if (drawn)
        HPDF_Page_Fill(page);
}

void PdfText::writeInvisibly(HPDF_Page page, const Word& word)
{
    UsedFont& used = load(fonts_.find(U'A').value());
    std::string utf8;
    double natural = 0;  // width, for a size of 1
    for (const char32_t c : visualText(word.run, word.from, word.to)) {
        const char16_t code = codeFor(c);
        used.meaning.emplace(code, c);
        append(utf8, code);
        natural += HPDF_Font_GetUnicodeWidth(used.font, code) / 1000.0;
    }
    const PlacedGlyph &first = word.run.glyphs[word.from], &last = word.run.glyphs[word.to - 1];
    const double width = last.pen_x + last.advance - first.pen_x;
    HPDF_Page_SetFontAndSize(page, used.font, float(word.size));
    HPDF_Page_BeginText(page);
    HPDF_Page_SetTextRenderingMode(page, HPDF_INVISIBLE);
    HPDF_Page_SetHorizontalScalling(
        page, float(std::clamp(100 * width / (natural * word.size), kLeastStretch_percent, kMostStretch_percent)));
    HPDF_Page_TextOut(page, float(word.x + first.pen_x), float(word.y), utf8.c_str());
    HPDF_Page_SetHorizontalScalling(page, 100);
    HPDF_Page_SetTextRenderingMode(page, HPDF_FILL);
    HPDF_Page_EndText(page);
}

char16_t PdfText::codeFor(char32_t hidden)
{
    const auto next = std::min<std::size_t>(kFirstHidden + hidden_.size(), kLastHidden);
    return hidden_.try_emplace(hidden, char16_t(next)).first->second;
}

}  // namespace vicon::report
