#pragma once

#include <string>
#include <string_view>

#include "image_object.h"

namespace vicon::ingest {

/// Why a compressed frame must not reach a decoder; empty when it may. What the stream says of itself has to agree with
/// the header: columns, rows, one component, and samples of as many bytes, unsigned ones where it says so. A decoder
/// believes the stream, and whoever gave it memory believed the header. Nothing is decoded.
/// @param stream one frame, its fragments joined
std::string whyNotDecodable(std::string_view stream, const PixelFormat& format, const std::string& transfer_syntax);

/// Of how many bits the samples of such a frame are; 0 where it does not say.
int sampleBits(std::string_view stream, const std::string& transfer_syntax);

}  // namespace vicon::ingest
