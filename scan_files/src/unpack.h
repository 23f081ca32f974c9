#pragma once

#include <cstddef>
#include <span>

namespace vicon::scan_files {

/// Unpacks a zlib stream (RFC 1950) into as many bytes as there is room for. Not MetaIO's own way: it asks zlib again
/// and again where a stream wants a dictionary, and takes a stream that is damaged or too short for a sound one.
/// @return whether the stream was sound, its checksum included, and filled the room
bool unpack(std::span<const std::byte> packed, std::span<std::byte> to);

}  // namespace vicon::scan_files
