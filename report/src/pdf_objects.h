#pragma once

#include <hpdf.h>

#include <map>
#include <vector>

#include "picture.h"

namespace vicon::report {

/// Embeds a picture losslessly, each row predicted from the one above as in PNG, which compresses rendered pictures far
/// better than libharu's own way.
HPDF_Image embedPicture(HPDF_Doc document, const Picture& picture);

/// Has these glyphs embedded with the font. libharu follows a composed glyph to its parts, but not to their parts: an
/// Arabic letter made of a base of other pieces and a dot would come out as the dot.
void embedGlyphs(HPDF_Font font, const std::vector<unsigned>& glyphs);

/// Replaces the ToUnicode map that libharu gives a "UTF-8" font, which is no such map (it has begincidrange), by one of
/// the codes used and the characters that they stand for.
void setToUnicode(HPDF_Font font, const std::map<char16_t, char32_t>& meaning);

}  // namespace vicon::report
