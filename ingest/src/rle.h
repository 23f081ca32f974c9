#pragma once

#include <string_view>
#include <vector>

#include "image_object.h"

namespace vicon::ingest {

/// Decodes one RLE frame (PS3.5 annex G) to little-endian pixels of `format`. Every pixel comes from the stream: one
/// that makes fewer is refused. Throws Error{bad_input} without a subject.
std::vector<char> decodeRle(std::string_view stream, const PixelFormat& format);

}  // namespace vicon::ingest
