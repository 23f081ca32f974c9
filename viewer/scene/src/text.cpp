#include "text.h"

#include <fribidi.h>
#include <ft2build.h>
#include FT_OUTLINE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <mutex>

#include "fonts.h"
#include "mask.h"

namespace vicon::viewer {
namespace {

constexpr double kRimShare = 0.11;  // of the text's height
constexpr double kRimStrength = 0.75;
constexpr Rgb kGround{0, 0, 0};
constexpr double kGroundStrength =
    0.6;  // white tissue keeps two fifths of its light: white letters on it contrast 4.5 : 1
constexpr double kGroundEdge = 0.35, kLetterTop = 0.72, kLetterBottom = 0.1;  // of the size
constexpr double kLeastSize_px = 6, kLeastShare = 0.6;  // of the wanted height: a name is read, not merely there
constexpr double kAscent = 0.95, kDescent = 0.25;       // of the size: room for accents and tails in every script

struct Library {
    std::mutex mutex;
    Fonts fonts;
};

Library& library()
{
    static Library one;
    return one;
}

bool isInvisible(std::uint32_t c)
{
    return c < 0x20 || c == 0x7f || c == FRIBIDI_CHAR_FILL || (c >= 0x200B && c <= 0x200F) ||
           (c >= 0x202A && c <= 0x202E) || (c >= 0x2060 && c <= 0x2069);
}

// Characters from left to right as they are drawn, Arabic letters in their joined forms.
std::vector<std::uint32_t> visualOrder(const std::string& utf8)
{
    std::vector<FriBidiChar> text(utf8.size() + 1);
    const auto count =
        fribidi_charset_to_unicode(FRIBIDI_CHAR_SET_UTF8, utf8.data(), FriBidiStrIndex(utf8.size()), text.data());
    if (count == 0)
        return {};
    text.resize(std::size_t(count));
    std::vector<FriBidiCharType> types(text.size());
    std::vector<FriBidiBracketType> brackets(text.size());
    std::vector<FriBidiLevel> levels(text.size());
    std::vector<FriBidiJoiningType> joining(text.size());
    fribidi_get_bidi_types(text.data(), count, types.data());
    fribidi_get_bracket_types(text.data(), count, types.data(), brackets.data());
    FriBidiParType base = FRIBIDI_PAR_WLTR;
    if (fribidi_get_par_embedding_levels_ex(types.data(), brackets.data(), count, &base, levels.data()) == 0)
        return {text.begin(), text.end()};
    fribidi_get_joining_types(text.data(), count, joining.data());
    fribidi_join_arabic(types.data(), count, levels.data(), joining.data());
    fribidi_shape(FRIBIDI_FLAGS_DEFAULT | FRIBIDI_FLAGS_ARABIC, levels.data(), count, joining.data(), text.data());
    if (fribidi_reorder_line(FRIBIDI_FLAGS_DEFAULT, types.data(), count, 0, base, levels.data(), text.data(),
                             nullptr) == 0)
        return {text.begin(), text.end()};
    std::vector<std::uint32_t> visible;
    for (const FriBidiChar c : text)
        if (!isInvisible(c))
            visible.push_back(c);
    return visible;
}

/// What no font has is called by its number: a box would not say what is missing.
std::vector<std::uint32_t> withoutBoxes(Fonts& fonts, const std::vector<std::uint32_t>& characters)
{
    std::vector<std::uint32_t> out;
    for (const std::uint32_t c : characters) {
        if (fonts.find(c).face) {
            out.push_back(c);
            continue;
        }
        std::array<char, 16> number{};
        const int length = std::snprintf(number.data(), number.size(), "[U+%04X]", unsigned(c));
        out.insert(out.end(), number.begin(), number.begin() + length);
    }
    return out;
}

void setSize(FT_Face face, double size_px)
{
    constexpr double kFixed = 64;  // FreeType counts in 64ths
    FT_Set_Char_Size(face, 0, FT_F26Dot6(std::lround(size_px * kFixed)), 72, 72);
}

TextLine inOneRow(Fonts& fonts, const std::vector<std::uint32_t>& characters, double size_px)
{
    TextLine line;
    line.size = size_px;
    for (const std::uint32_t c : characters) {
        const auto glyph = fonts.find(c);
        if (!glyph.face)
            continue;
        setSize(glyph.face, size_px);
        if (FT_Load_Glyph(glyph.face, glyph.glyph, FT_LOAD_NO_HINTING) != 0)
            continue;
        line.glyphs.push_back({glyph, line.width});
        line.width += double(glyph.face->glyph->linearHoriAdvance) / 65536.0;
    }
    return line;
}

TextLine inOneRow(Fonts& fonts, const std::string& utf8, double size_px)
{
    return inOneRow(fonts, withoutBoxes(fonts, visualOrder(utf8)), size_px);
}

std::string firstCharacters(const std::string& utf8, std::size_t count)
{
    std::size_t end = 0;
    for (; end < utf8.size(); ++end)
        if ((utf8[end] & 0xC0) != 0x80 && count-- == 0)
            break;
    return utf8.substr(0, end);
}

/// So much of the text as fits at this size, with a sign that there is more.
TextLine cutOff(Fonts& fonts, const OverlayText& text, double size_px, double whole_width_px)
{
    const auto all = std::count_if(text.text.begin(), text.text.end(), [](char c) { return (c & 0xC0) != 0x80; });
    for (auto count = std::size_t(double(all) * text.most_width_px / whole_width_px);; --count) {
        TextLine line = inOneRow(fonts, firstCharacters(text.text, count) + "…", size_px);
        if (line.width <= text.most_width_px || count == 0)
            return line;
    }
}

TextLine fitted(Fonts& fonts, const OverlayText& text)
{
    TextLine wanted = inOneRow(fonts, text.text, text.height_px);
    if (wanted.width <= text.most_width_px)
        return wanted;
    const double smaller = text.height_px * text.most_width_px / wanted.width;
    const double least = std::max(kLeastSize_px, kLeastShare * text.height_px);
    if (smaller >= least)
        return inOneRow(fonts, text.text, smaller);
    return cutOff(fonts, text, least, wanted.width * least / text.height_px);
}

Pixel beginOf(const OverlayText& text, const TextLine& line)
{
    Pixel p = text.at;
    if (text.across == Across::centre)
        p.x -= line.width / 2;
    if (text.across == Across::right)
        p.x -= line.width;
    if (text.along == Along::top)
        p.y += kAscent * line.size;
    if (text.along == Along::middle)
        p.y += (kAscent - kDescent) / 2 * line.size;
    if (text.along == Along::bottom)
        p.y -= kDescent * line.size;
    return {std::round(p.x), std::round(p.y)};
}

void draw(Mask& mask, const PlacedGlyph& placed, Pixel begin, double size_px)
{
    FT_Face face = placed.glyph.face;
    setSize(face, size_px);
    if (FT_Load_Glyph(face, placed.glyph.glyph, FT_LOAD_NO_HINTING) != 0)
        return;
    const double x = begin.x + placed.x, whole = std::floor(x);
    FT_Outline_Translate(&face->glyph->outline, FT_Pos((x - whole) * 64), 0);
    if (FT_Render_Glyph(face->glyph, FT_RENDER_MODE_NORMAL) != 0)
        return;
    const FT_Bitmap& bitmap = face->glyph->bitmap;
    for (unsigned row = 0; row < bitmap.rows; ++row)
        for (unsigned column = 0; column < bitmap.width; ++column)
            mask.add(int(whole) + face->glyph->bitmap_left + int(column),
                     int(begin.y) - face->glyph->bitmap_top + int(row),
                     bitmap.buffer[std::ptrdiff_t(row) * bitmap.pitch + column]);
}

}  // namespace

TextLine layOut(const OverlayText& text)
{
    const std::lock_guard lock(library().mutex);
    TextLine line = fitted(library().fonts, text);
    line.begin = beginOf(text, line);
    line.color = text.color;
    return line;
}

TextSize sizeOf(const TextLine& line)
{
    return {line.width, (kAscent + kDescent) * line.size};
}

void paintGround(Picture& picture, const std::vector<TextLine>& lines, Mask& mask)
{
    mask.clear();
    for (const TextLine& line : lines)
        if (!line.glyphs.empty())
            mask.addBox({line.begin.x, line.begin.y - kLetterTop * line.size, line.width,
                         (kLetterTop + kLetterBottom) * line.size},
                        kGroundEdge * line.size);
    mask.blendInto(picture, kGround, kGroundStrength);
}

void paintText(Picture& picture, const TextLine& line, Mask& letters, Mask& rim)
{
    const std::lock_guard lock(library().mutex);
    letters.clear();
    for (const PlacedGlyph& placed : line.glyphs)
        draw(letters, placed, line.begin, line.size);
    rim.clear();
    letters.growInto(rim, std::max(1.0, kRimShare * line.size));
    rim.blendInto(picture, kGround, kRimStrength);
    letters.blendInto(picture, line.color, 1);
}

}  // namespace vicon::viewer
