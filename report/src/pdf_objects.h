#pragma once

#include <hpdf.h>

#include <cstdint>
#include <map>
#include <vector>

#include "picture.h"

namespace vicon::report {

/// A picture's stream: each row predicted from the one above as in PNG, which compresses rendered pictures far better
/// than libharu's own way, and deflated. Any thread may make it.
std::vector<std::uint8_t> packed(const Picture& picture);
/// Embeds a picture whose stream comes later, by setPacked().
HPDF_Image addImage(HPDF_Doc document, int width, int height, int channels);
void setPacked(HPDF_Image image, const std::vector<std::uint8_t>& stream);

/// Has these glyphs embedded with the font. libharu follows a composed glyph to its parts, but not to their parts: an
/// Arabic letter made of a base of other pieces and a dot would come out as the dot.
void embedGlyphs(HPDF_Font font, const std::vector<unsigned>& glyphs);

/// Replaces the ToUnicode map that libharu gives a "UTF-8" font, which is no such map (it has begincidrange), by one of
/// the codes used and the characters that they stand for.
void setToUnicode(HPDF_Font font, const std::map<char16_t, char32_t>& meaning);

}  // namespace vicon::report
