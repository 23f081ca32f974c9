#pragma once

#include "vicon/viewer/scene/canvas.h"

namespace vicon::viewer {

// Text through FreeType; order and Arabic joining through FriBidi.
void paintText(Picture& picture, const OverlayText& text);
TextSize measureText(const OverlayText& text);

}  // namespace vicon::viewer
