#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vicon/text/font_set.h"

namespace vicon::text {

/// How much of each pixel a glyph covers, 0 to 255, row by row from the top.
struct GlyphMask {
    int left = 0, top = 0;  ///< of the first pixel: columns from the glyph's origin, rows above the base line
    int width = 0, height = 0;
    std::vector<std::uint8_t> cover;
};
/// `right_px` and `up_px`: by how much the glyph is moved, less than a pixel. Empty: there is nothing to draw.
GlyphMask glyphMaskOf(const FontSet& fonts, int font, unsigned glyph, double size_px, double right_px, double up_px);

/// A part of a glyph's outline, for a font size of 1; y upwards from the base line. A contour begins with `move` and is
/// closed; what its contours wind around is filled.
struct OutlinePart {
    enum class Kind { move, line, curve } kind = Kind::move;
    struct Point {
        double x = 0, y = 0;
    };
    std::array<Point, 3> points;  ///< the last one alone, but of a (cubic Bézier) curve all
};
std::vector<OutlinePart> outlineOf(const FontSet& fonts, int font, unsigned glyph);

/// 0: the font has none.
unsigned glyphOf(const FontSet& fonts, int font, char32_t c);
/// Width of a glyph for a font size of 1.
double advance_em(const FontSet& fonts, int font, unsigned glyph);
/// The glyphs that a glyph is composed of, with what those are composed of; empty: it is drawn by itself.
std::vector<unsigned> componentsOf(const FontSet& fonts, int font, unsigned glyph);

}  // namespace vicon::text
