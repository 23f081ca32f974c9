#include "text.h"

#include <fribidi.h>
#include <unicode/brkiter.h>
#include <unicode/normalizer2.h>
#include <unicode/uchar.h>
#include <unicode/unistr.h>
#include <unicode/uscript.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>

#include "vicon/core/error.h"

namespace vicon::report {
namespace {

/// What FriBidi leaves where a ligature has swallowed a letter.
constexpr char32_t kFill = FRIBIDI_CHAR_FILL;

/// Invisible characters that joining, direction and line breaking look at; other invisible ones are left out.
bool steersLayout(char32_t c)
{
    return c == 0x200b || c == 0x200c || c == 0x200d || c == 0x200e || c == 0x200f || c == 0x061c;
}

bool isInvisible(char32_t c)
{
    return u_hasBinaryProperty(UChar32(c), UCHAR_DEFAULT_IGNORABLE_CODE_POINT) || c == kFill;
}

bool isMark(char32_t c)
{
    return u_charType(UChar32(c)) == U_NON_SPACING_MARK;
}

/// Invalid bytes become U+FFFD; then NFC, so that an accent finds its precomposed glyph.
std::u32string normalised(std::string_view utf8)
{
    UErrorCode status = U_ZERO_ERROR;
    const icu::Normalizer2* nfc = icu::Normalizer2::getNFCInstance(status);
    icu::UnicodeString text = icu::UnicodeString::fromUTF8(icu::StringPiece(utf8.data(), std::int32_t(utf8.size())));
    if (U_SUCCESS(status))
        text = nfc->normalize(text, status);
    if (U_FAILURE(status))
        throw Error(ErrorCode::internal, "the text of the report cannot be normalised", u_errorName(status));
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

bool isKana(char32_t c)
{
    UErrorCode status = U_ZERO_ERROR;
    const UScriptCode script = uscript_getScript(UChar32(c), &status);
    return script == USCRIPT_HIRAGANA || script == USCRIPT_KATAKANA;
}

/// Where a line may end: offsets into the text, which lies within the basic plane, so UTF-16 and UTF-32 count alike.
std::vector<std::size_t> breakOffsets(const std::u32string& text)
{
    const icu::UnicodeString utf16(
        icu::UnicodeString::fromUTF32(reinterpret_cast<const UChar32*>(text.data()), std::int32_t(text.size())));
    UErrorCode status = U_ZERO_ERROR;
    const std::unique_ptr<icu::BreakIterator> breaks(
        icu::BreakIterator::createLineInstance(icu::Locale::getRoot(), status));
    if (U_FAILURE(status))
        throw Error(ErrorCode::internal, "lines cannot be broken", u_errorName(status));
    breaks->setText(utf16);
    std::vector<std::size_t> out;
    for (std::int32_t at = breaks->next(); at != icu::BreakIterator::DONE; at = breaks->next())
        out.push_back(std::size_t(at));
    return out;
}

/// A paragraph after the bidirectional algorithm and joining, still in logical order.
class Paragraph {
public:
    explicit Paragraph(const std::u32string& text)
        : shaped_(text.begin(), text.end()), types_(text.size()), levels_(text.size())
    {
        const auto size = FriBidiStrIndex(text.size());
        fribidi_get_bidi_types(shaped_.data(), size, types_.data());
        std::vector<FriBidiBracketType> brackets(text.size());
        fribidi_get_bracket_types(shaped_.data(), size, types_.data(), brackets.data());
        if (fribidi_get_par_embedding_levels_ex(types_.data(), brackets.data(), size, &direction_, levels_.data()) == 0)
            throw Error(ErrorCode::no_memory, "the direction of a text cannot be found");
        std::vector<FriBidiJoiningType> joining(text.size());
        fribidi_get_joining_types(shaped_.data(), size, joining.data());
        fribidi_join_arabic(types_.data(), size, levels_.data(), joining.data());
        fribidi_shape(FRIBIDI_FLAGS_DEFAULT | FRIBIDI_FLAGS_ARABIC, levels_.data(), size, joining.data(),
                      shaped_.data());
    }

    char32_t at(std::size_t n) const { return shaped_[n]; }
    bool rightToLeft() const { return FRIBIDI_IS_RTL(direction_); }

    std::u32string visual(std::size_t from, std::size_t to) const
    {
        std::vector<FriBidiChar> line = shaped_;
        std::vector<FriBidiLevel> levels = levels_;
        if (to > from && fribidi_reorder_line(FRIBIDI_FLAGS_DEFAULT | FRIBIDI_FLAGS_ARABIC, types_.data(),
                                              FriBidiStrIndex(to - from), FriBidiStrIndex(from), direction_,
                                              levels.data(), line.data(), nullptr) == 0)
            throw Error(ErrorCode::no_memory, "a line cannot be put in order");
        return {line.begin() + std::ptrdiff_t(from), line.begin() + std::ptrdiff_t(to)};
    }

private:
    std::vector<FriBidiChar> shaped_;
    std::vector<FriBidiCharType> types_;
    std::vector<FriBidiLevel> levels_;
    FriBidiParType direction_ = FRIBIDI_PAR_WLTR;
};

/// Chooses fonts, and keeps a mark in the font of the letter below it where that has it.
class FontChooser {
public:
    FontChooser(const FontSet& fonts, FontSet::Wish wish) : fonts_(fonts), wish_(wish) {}

    int fontFor(char32_t c)
    {
        if (!(isMark(c) && last_ >= 0 && fonts_.has(last_, c)))
            last_ = fonts_.find(c, wish_).value_or(0);
        return last_;
    }

private:
    const FontSet& fonts_;
    FontSet::Wish wish_;
    int last_ = -1;
};

TextLine assemble(const std::u32string& visual, TextStyle style, FontSet::Wish wish, const FontSet& fonts)
{
    TextLine line{.size = style.size};
    FontChooser chooser(fonts, wish);
    for (const char32_t c : visual) {
        if (isInvisible(c))
            continue;
        const int font = chooser.fontFor(c);
        if (line.runs.empty() || line.runs.back().font != font)
            line.runs.push_back({font, {}, line.width});
        line.runs.back().codes += char16_t(c);
        line.width += style.size * fonts.advance_em(font, c);
    }
    return line;
}

std::size_t withoutTrailingSpaces(const std::u32string& text, std::size_t from, std::size_t to)
{
    while (to > from && u_isUWhiteSpace(UChar32(text[to - 1])))
        --to;
    return to;
}

}  // namespace

std::u32string Typesetter::printable(std::string_view utf8, FontSet::Wish& wish)
{
    std::u32string out;
    const std::u32string text = normalised(utf8);
    wish.japanese = std::any_of(text.begin(), text.end(), isKana);
    for (std::size_t n = 0; n < text.size(); ++n) {
        const char32_t c = text[n];
        const bool new_line = c == U'\n' || c == 0x2028 || c == 0x2029 || c == 0x85 || c == U'\r';
        if (c == U'\r' && n + 1 < text.size() && text[n + 1] == U'\n')
            continue;
        if (new_line)
            out += U'\n';
        else if (u_iscntrl(UChar32(c)) && !isInvisible(c))
            out += U' ';
        else if (steersLayout(c) || (c != kInvalidUtf8 && !isInvisible(c) && fonts_.find(c, wish)))
            out += c;
        else if (isInvisible(c))
            continue;
        else {
            missing_.insert(c);
            out += inBrackets(c);
        }
    }
    return out;
}

std::vector<TextLine> Typesetter::lines(std::string_view utf8, TextStyle style, double max_width)
{
    FontSet::Wish wish{.bold = style.bold};
    const std::u32string text = printable(utf8, wish);
    std::vector<TextLine> out;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t to = std::min(text.find(U'\n', from), text.size());
        breakParagraph(text.substr(from, to - from), style, wish, max_width, out);
        from = to + 1;
    }
    return out;
}

TextLine Typesetter::line(std::string_view utf8, TextStyle style)
{
    FontSet::Wish wish{.bold = style.bold};
    std::u32string text = printable(utf8, wish);
    std::replace(text.begin(), text.end(), U'\n', U' ');
    std::vector<TextLine> out;
    breakParagraph(text, style, wish, 1e9, out);
    return out.front();
}

void Typesetter::breakParagraph(const std::u32string& text, TextStyle style, FontSet::Wish wish, double max_width,
                                std::vector<TextLine>& out) const
{
    if (text.empty()) {
        out.push_back({.size = style.size});
        return;
    }
    const Paragraph paragraph(text);
    std::vector<double> x(text.size() + 1, 0);  // sums of widths, in logical order
    FontChooser chooser(fonts_, wish);
    for (std::size_t n = 0; n < text.size(); ++n) {
        const char32_t c = paragraph.at(n);
        x[n + 1] = x[n] + (isInvisible(c) ? 0 : style.size * fonts_.advance_em(chooser.fontFor(c), c));
    }
    const std::vector<std::size_t> breaks = breakOffsets(text);
    for (std::size_t from = 0; from < text.size();) {
        const auto fits = [&](std::size_t to) {
            return x[withoutTrailingSpaces(text, from, to)] - x[from] <= max_width;
        };
        std::size_t to = from;
        for (auto at = std::upper_bound(breaks.begin(), breaks.end(), from); at != breaks.end() && fits(*at); ++at)
            to = *at;
        if (to == from)  // a word wider than the line
            for (to = from + 1; to < text.size() && (isMark(text[to]) || fits(to + 1));)
                ++to;
        out.push_back(assemble(paragraph.visual(from, withoutTrailingSpaces(text, from, to)), style, wish, fonts_));
        out.back().right_to_left = paragraph.rightToLeft();
        from = to;
    }
}

}  // namespace vicon::report
