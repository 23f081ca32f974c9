#include "text.h"

#include <ft2build.h>
#include FT_OUTLINE_H

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "fonts.h"
#include "mask.h"

namespace vicon::viewer {
namespace {

constexpr double kRimShare = 0.11;  // of the text's height
constexpr double kRimStrength = 0.75;
constexpr Rgb kGround{0, 0, 0};
constexpr double kGroundStrength =
    0.6;  // white tissue keeps two fifths of its light: white letters on it contrast 4.5 : 1
constexpr double kLetterTop = 0.72, kLetterBottom = 0.1;  // of the size
// Of the size: lines of a caption run together without an edge; around single letters as much would be a blot.
constexpr double kLeastGroundEdge = 0.35, kMostGroundEdge = 0.9, kGroundEdgePerWidth = 0.15;
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

TextLine inOneRow(Fonts& fonts, const std::string& utf8, double size_px)
{
    GlyphRow row = shaped(fonts, utf8, size_px);
    TextLine line;
    line.size = size_px;
    line.glyphs = std::move(row.glyphs);
    line.width = row.width;
    return line;
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
    FT_Outline_Translate(&face->glyph->outline, FT_Pos((x - whole) * 64), FT_Pos(placed.y * 64));
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

Area areaOf(const TextLine& line)
{
    const TextSize size = sizeOf(line);
    return {line.begin.x, line.begin.y - kAscent * line.size, size.width_px, size.height_px};
}

void paintGround(Picture& picture, const std::vector<TextLine>& lines, Mask& mask)
{
    mask.clear();
    for (const TextLine& line : lines)
        if (!line.glyphs.empty())
            mask.addBox({line.begin.x, line.begin.y - kLetterTop * line.size, line.width,
                         (kLetterTop + kLetterBottom) * line.size},
                        std::clamp(kGroundEdgePerWidth * line.width, kLeastGroundEdge * line.size,
                                   kMostGroundEdge * line.size));
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
