#pragma once

#include <vector>

#include "mask.h"
#include "vicon/text/typesetter.h"

namespace vicon::viewer {

/// A text as it will be painted.
struct PlacedText {
    text::TextLine line;
    Pixel begin;  ///< on its base line
    Rgb color;
};

std::vector<PlacedText> layOut(const std::vector<OverlayText>& texts);
TextSize sizeOf(const PlacedText& text);
Area areaOf(const PlacedText& text);

/// Darkens what lies below the texts, once where they overlap, so that they read on bright tissue as on air. The masks
/// are room to work in, as large as the picture.
void paintGround(Picture& picture, const std::vector<PlacedText>& texts, Mask& mask);
void paintText(Picture& picture, const PlacedText& text, Mask& letters, Mask& rim);

}  // namespace vicon::viewer
