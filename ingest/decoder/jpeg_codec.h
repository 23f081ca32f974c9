#pragma once

#include <string>
#include <vector>

#include "image_object.h"

namespace vicon::ingest {

/// Reads what DCMTK reads once, before files are out of reach.
void setUpJpeg();

/// Decodes one JPEG stream (baseline, extended, progressive, lossless) to little-endian pixels of `format`. Throws
/// Error{bad_input} without a subject.
std::vector<char> decodeWithDcmtk(const std::string& stream, const PixelFormat& format,
                                  const std::string& transfer_syntax);

}  // namespace vicon::ingest
