#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace vicon::scan_files {

/// A zlib stream (RFC 1950) of the bytes, packed fast rather than well. By libdeflate, which packs a scan's labels in
/// half of zlib's time. Throws std::bad_alloc.
std::vector<std::byte> pack(std::span<const std::byte> bytes);

/// Unpacks a zlib stream into as many bytes as there is room for. Not MetaIO's own way: it asks zlib again and again
/// where a stream wants a dictionary, and takes a stream that is damaged or too short for a sound one.
/// @return whether the stream was sound, its checksum included, and filled the room
bool unpack(std::span<const std::byte> packed, std::span<std::byte> to);

}  // namespace vicon::scan_files
