#pragma once

#include <ft2build.h>
#include FT_FREETYPE_H

namespace vicon::text {

inline constexpr double kFixed = 64;  ///< FreeType and HarfBuzz count in 64ths of a pixel

/// What FreeType draws and HarfBuzz measures from now on.
void setSize(FT_Face face, double size_px);

}  // namespace vicon::text
