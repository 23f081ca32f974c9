#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "image_object.h"

namespace vicon::ingest {

/// Decodes one JPEG 2000 or JPEG-LS code stream to little-endian pixels of `format`. Throws Error{bad_input} without a
/// subject.
std::vector<char> decodeWithGdcm(const std::string& stream, const PixelFormat& format,
                                 const std::string& transfer_syntax);

}  // namespace vicon::ingest
