#pragma once

#include "mask.h"

namespace vicon::viewer {

// Text through FreeType; order and Arabic joining through FriBidi. The masks are room to work in, as large as the
// picture.
void paintText(Picture& picture, const OverlayText& text, Mask& letters, Mask& rim);
TextSize measureText(const OverlayText& text);

}  // namespace vicon::viewer
