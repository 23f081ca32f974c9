#pragma once

#include <vector>

#include "vicon/viewer/model/overlay.h"

namespace vicon::viewer {

/// Where the caption of the slices is written, and the room that it leaves for the close-up.
struct CaptionPanel {
    Overlay overlay;
    Area close_up;  ///< all below the text, or a square beside it, whichever shows more; empty: there is no room
};

/// Lays out lines of text from the top. They are written smaller before the close-up becomes small, and what is below
/// the panel is left out, with a sign that there was more.
CaptionPanel captionPanel(const std::vector<OverlayText>& lines, int width, int height, double pixel_ratio = 1);

}  // namespace vicon::viewer
