#pragma once

#include <hpdf.h>

#include <set>

#include "picture.h"

namespace vicon::report {

/// Embeds a picture losslessly, each row predicted from the one above as in PNG, which compresses rendered pictures far
/// better than libharu's own way.
HPDF_Image embedPicture(HPDF_Doc document, const Picture& picture);

/// Replaces the ToUnicode map that libharu gives a "UTF-8" font, which is no such map (it has begincidrange), by one of
/// the codes used. Arabic presentation forms map to their letters.
void setToUnicode(HPDF_Font font, const std::set<char16_t>& codes);

}  // namespace vicon::report
