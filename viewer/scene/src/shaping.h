#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fonts.h"

namespace vicon::viewer {

/// A glyph of a line of text. Positions in pixels; y grows upwards from the base line.
struct PlacedGlyph {
    Fonts::Found glyph;
    double x = 0, y = 0;
};

struct GlyphRow {
    std::vector<PlacedGlyph> glyphs;  ///< from left to right
    double width = 0;
};

/// Glyphs of a text as its scripts are written: order from right to left by FriBidi; joined, reordered and stacked
/// letters by HarfBuzz. What no font has is called by its number.
GlyphRow shaped(Fonts& fonts, const std::string& utf8, double size_px);

void setSize(FT_Face face, double size_px);

}  // namespace vicon::viewer
