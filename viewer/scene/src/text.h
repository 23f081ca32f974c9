#pragma once

#include <vector>

#include "fonts.h"
#include "mask.h"

namespace vicon::viewer {

struct PlacedGlyph {
    Fonts::Found glyph;
    double x = 0;  ///< from the line's begin
};

/// A text as it will be painted.
struct TextLine {
    std::vector<PlacedGlyph> glyphs;
    double width = 0, size = 0;
    Pixel begin;  ///< on its base line
    Rgb color;
};

/// Glyphs through FreeType; order and Arabic joining through FriBidi.
TextLine layOut(const OverlayText& text);
TextSize sizeOf(const TextLine& line);

/// Darkens what lies below the lines, once where they overlap, so that they read on bright tissue as on air. The masks
/// are room to work in, as large as the picture.
void paintGround(Picture& picture, const std::vector<TextLine>& lines, Mask& mask);
void paintText(Picture& picture, const TextLine& line, Mask& letters, Mask& rim);

}  // namespace vicon::viewer
