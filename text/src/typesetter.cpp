#include "vicon/text/typesetter.h"

#include <unicode/normalizer2.h>
#include <unicode/uchar.h>
#include <unicode/uniset.h>
#include <unicode/unistr.h>
#include <unicode/uscript.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "break_lines.h"
#include "shape.h"
#include "vicon/core/error.h"

namespace vicon::text {
namespace {

/// Glyphs for paper are measured at this size, where rounding to 64ths of a pixel is nothing.
constexpr double kFineSize = 1000;

bool isKana(char32_t c)
{
    UErrorCode status = U_ZERO_ERROR;
    const UScriptCode script = uscript_getScript(UChar32(c), &status);
    return script == USCRIPT_HIRAGANA || script == USCRIPT_KATAKANA;
}

/// Invalid bytes become U+FFFD; then NFC, so that an accent finds its precomposed glyph. Compatibility ideographs stay:
/// they are forms of a character that a name may insist on.
std::u32string normalised(std::string_view utf8)
{
    UErrorCode status = U_ZERO_ERROR;
    static const icu::UnicodeSet normal(u"[^\\uF900-\\uFAFF\\U0002F800-\\U0002FA1F]", status);
    icu::UnicodeString text;
    if (const icu::Normalizer2* nfc = icu::Normalizer2::getNFCInstance(status); U_SUCCESS(status))
        icu::FilteredNormalizer2(*nfc, normal)
            .normalize(icu::UnicodeString::fromUTF8(icu::StringPiece(utf8.data(), std::int32_t(utf8.size()))), text,
                       status);
    if (U_FAILURE(status))
        throw Error(ErrorCode::internal, "a text cannot be normalised", u_errorName(status));
    std::u32string out;
    for (std::int32_t at = 0; at < text.length(); at = text.moveIndex32(at, 1))
        out += char32_t(text.char32At(at));
    return out;
}

std::u32string inBrackets(char32_t c)
{
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "[U+%04X]", unsigned(c));
    return {text.begin(), std::find(text.begin(), text.end(), '\0')};
}

TextLine enlarged(TextLine line, double factor)
{
    line.size *= factor;
    line.width *= factor;
    for (GlyphRun& run : line.runs)
        for (PlacedGlyph& glyph : run.glyphs)
            for (double* length : {&glyph.x, &glyph.y, &glyph.pen_x, &glyph.advance})
                *length *= factor;
    return line;
}

/// Sets parts of a paragraph in one style.
struct Setting {
    FontSet& fonts;
    Paragraph paragraph;
    FontStyle style;
    double size;

    TextLine line(std::size_t from, std::size_t to) const
    {
        if (fonts.medium() == FontSet::Medium::screen)
            return shaped(fonts, paragraph, from, to, style, size);
        return enlarged(shaped(fonts, paragraph, from, to, style, kFineSize), size / kFineSize);
    }
};

}  // namespace

void TextLine::append(TextLine more)
{
    for (GlyphRun& run : more.runs) {
        for (PlacedGlyph& glyph : run.glyphs) {
            glyph.x += width;
            glyph.pen_x += width;
        }
        runs.push_back(std::move(run));
    }
    width += more.width;
}

std::u32string Typesetter::printable(std::string_view utf8, FontStyle& style)
{
    std::u32string out;
    const std::u32string text = normalised(utf8);
    style.japanese = std::any_of(text.begin(), text.end(), isKana);
    for (std::size_t n = 0; n < text.size(); ++n) {
        const char32_t c = text[n];
        const bool new_line = c == U'\n' || c == 0x2028 || c == 0x2029 || c == 0x85 || c == U'\r';
        const bool works_unseen = isSpent(c) || isJoiner(c);
        const bool invisible = u_hasBinaryProperty(UChar32(c), UCHAR_DEFAULT_IGNORABLE_CODE_POINT);
        if (c == U'\r' && n + 1 < text.size() && text[n + 1] == U'\n')
            continue;
        if (new_line)
            out += U'\n';
        else if (invisible && !works_unseen)
            continue;
        else if (u_iscntrl(UChar32(c)) && !works_unseen)
            out += U' ';
        else if (works_unseen || (c != kInvalidUtf8 && fonts_.find(c, style)))
            out += c;
        else {
            missing_.insert(c);
            out += inBrackets(c);
        }
    }
    return out;
}

std::vector<TextLine> Typesetter::lines(std::string_view utf8, TextStyle style, double max_width)
{
    FontStyle font{.bold = style.bold};
    const std::u32string text = printable(utf8, font);
    std::vector<TextLine> out;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t to = std::min(text.find(U'\n', from), text.size());
        const Setting setting{fonts_, paragraphOf(text.substr(from, to - from)), font, style.size};
        const auto spans = breakLines(setting.paragraph.text, max_width,
                                      [&](std::size_t a, std::size_t b) { return setting.line(a, b).width; });
        for (const LineSpan& span : spans)
            out.push_back(setting.line(span.from, span.to));
        if (spans.empty())
            out.push_back(setting.line(0, 0));
        from = to + 1;
    }
    return out;
}

TextLine Typesetter::line(std::string_view utf8, TextStyle style)
{
    FontStyle font{.bold = style.bold};
    std::u32string text = printable(utf8, font);
    std::replace(text.begin(), text.end(), U'\n', U' ');
    const Setting setting{fonts_, paragraphOf(std::move(text)), font, style.size};
    return setting.line(0, setting.paragraph.text.size());
}

}  // namespace vicon::text
