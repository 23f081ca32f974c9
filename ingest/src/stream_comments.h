#pragma once

#include <cstdint>
#include <span>

namespace vicon::ingest {

/// Overwrites what a JPEG, JPEG-LS or JPEG 2000 stream says beside its picture (comments, application segments) with
/// zeros, in place; the picture stays what it was. Other streams are left as they are.
void blankComments(std::span<std::uint8_t> stream);

}  // namespace vicon::ingest
