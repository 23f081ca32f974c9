#include "text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>

#include "mask.h"
#include "vicon/core/error.h"
#include "vicon/text/glyph.h"

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
constexpr double kRounding_px = 1;                      // letters are set on whole pixels
constexpr double kAscent = 0.95, kDescent = 0.25;       // of the size: room for accents and tails in every script

/// The installed fonts, shared by all threads.
struct Library {
    std::mutex mutex;
    text::FontSet fonts{{"/usr/share/fonts", "/usr/local/share/fonts"}, text::FontSet::Medium::screen};
    text::Typesetter type{fonts};

    Library()
    {
        if (!fonts.find(U'A'))
            throw Error(ErrorCode::no_display, "no fonts are installed", "/usr/share/fonts",
                        "install the Debian package 'fonts-dejavu-core'");
    }
};

Library& library()
{
    static Library one;
    return one;
}

std::string firstCharacters(const std::string& utf8, std::size_t count)
{
    std::size_t end = 0;
    for (; end < utf8.size(); ++end)
        if ((utf8[end] & 0xC0) != 0x80 && count-- == 0)
            break;
    return utf8.substr(0, end);
}

/// So much of the text as fits at this size, with a sign that there is more where that is not all.
text::TextLine cutOff(text::Typesetter& type, const OverlayText& text, double size_px)
{
    text::TextLine whole = type.line(text.text, {.size = size_px});
    if (whole.width <= text.most_width_px + kRounding_px)
        return whole;
    const auto all = std::count_if(text.text.begin(), text.text.end(), [](char c) { return (c & 0xC0) != 0x80; });
    for (auto count = std::size_t(double(all) * text.most_width_px / whole.width);; --count) {
        text::TextLine line = type.line(firstCharacters(text.text, count) + "…", {.size = size_px});
        if (line.width <= text.most_width_px || count == 0)
            return line;
    }
}

/// At which a text fits, or is cut off.
double fittingSize(text::Typesetter& type, const OverlayText& text)
{
    const double width = type.line(text.text, {.size = text.height_px}).width;
    if (width <= text.most_width_px)
        return text.height_px;
    const double least = std::max(kLeastSize_px, kLeastShare * text.height_px);
    return std::max(least, text.height_px * text.most_width_px / width);
}

Pixel beginOf(const OverlayText& text, const text::TextLine& line)
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

void draw(Mask& mask, int font, const text::PlacedGlyph& glyph, const PlacedText& text)
{
    const double x = text.begin.x + glyph.x, whole = std::floor(x);
    const text::GlyphMask drawn = glyphMaskOf(library().fonts, font, glyph.glyph, text.line.size, x - whole, glyph.y);
    for (int row = 0; row < drawn.height; ++row)
        for (int column = 0; column < drawn.width; ++column)
            mask.add(int(whole) + drawn.left + column, int(text.begin.y) - drawn.top + row,
                     drawn.cover[std::size_t(row) * std::size_t(drawn.width) + std::size_t(column)]);
}

}  // namespace

std::vector<PlacedText> layOut(const std::vector<OverlayText>& texts)
{
    const std::lock_guard lock(library().mutex);
    std::map<int, double> block_px;
    std::vector<double> sizes_px;
    for (const OverlayText& text : texts) {
        sizes_px.push_back(fittingSize(library().type, text));
        double& smallest_px = block_px.try_emplace(text.block, sizes_px.back()).first->second;
        smallest_px = std::min(smallest_px, sizes_px.back());
    }
    std::vector<PlacedText> placed;
    for (std::size_t n = 0; n < texts.size(); ++n) {
        const OverlayText& text = texts[n];
        placed.push_back(
            {cutOff(library().type, text, text.block ? block_px[text.block] : sizes_px[n]), {}, text.color});
        placed.back().begin = beginOf(text, placed.back().line);
    }
    return placed;
}

TextSize sizeOf(const PlacedText& text)
{
    return {text.line.width, (kAscent + kDescent) * text.line.size};
}

Area areaOf(const PlacedText& text)
{
    const TextSize size = sizeOf(text);
    return {text.begin.x, text.begin.y - kAscent * text.line.size, size.width_px, size.height_px};
}

void paintGround(Picture& picture, const std::vector<PlacedText>& texts, Mask& mask)
{
    mask.clear();
    for (const PlacedText& text : texts)
        if (const auto& [runs, width, size, right_to_left] = text.line; !runs.empty())
            mask.addBox({text.begin.x, text.begin.y - kLetterTop * size, width, (kLetterTop + kLetterBottom) * size},
                        std::clamp(kGroundEdgePerWidth * width, kLeastGroundEdge * size, kMostGroundEdge * size));
    mask.blendInto(picture, kGround, kGroundStrength);
}

void paintText(Picture& picture, const PlacedText& text, Mask& letters, Mask& rim)
{
    const std::lock_guard lock(library().mutex);
    letters.clear();
    for (const text::GlyphRun& run : text.line.runs)
        for (const text::PlacedGlyph& glyph : run.glyphs)
            draw(letters, run.font, glyph, text);
    rim.clear();
    letters.growInto(rim, std::max(1.0, kRimShare * text.line.size));
    rim.blendInto(picture, kGround, kRimStrength);
    letters.blendInto(picture, text.color, 1);
}

}  // namespace vicon::viewer
