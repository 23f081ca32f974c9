#pragma once

#include <vector>

#include "mask.h"
#include "shaping.h"

namespace vicon::viewer {

/// A text as it will be painted.
struct TextLine {
    std::vector<PlacedGlyph> glyphs;
    double width = 0, size = 0;
    Pixel begin;  ///< on its base line
    Rgb color;
};

TextLine layOut(const OverlayText& text);
TextSize sizeOf(const TextLine& line);
Area areaOf(const TextLine& line);

/// Darkens what lies below the lines, once where they overlap, so that they read on bright tissue as on air. The masks
/// are room to work in, as large as the picture.
void paintGround(Picture& picture, const std::vector<TextLine>& lines, Mask& mask);
void paintText(Picture& picture, const TextLine& line, Mask& letters, Mask& rim);

}  // namespace vicon::viewer
