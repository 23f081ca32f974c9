#pragma once

#include "paragraph.h"
#include "vicon/text/typesetter.h"

namespace vicon::text {

/// The glyphs of a part of a paragraph, as one line.
TextLine shaped(FontSet& fonts, const Paragraph& paragraph, std::size_t from, std::size_t to, FontStyle style,
                double size);

}  // namespace vicon::text
