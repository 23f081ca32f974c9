#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "image_object.h"

namespace vicon::ingest {

/// Decodes the frames of one object. Not for several threads at once; open one for each. What it throws says why, not
/// where: the caller knows the file.
class FrameDecoder {
public:
    /// Throws Error{bad_input} when the object cannot be read.
    explicit FrameDecoder(const ImageObject& object);
    ~FrameDecoder();
    FrameDecoder(const FrameDecoder&) = delete;
    FrameDecoder& operator=(const FrameDecoder&) = delete;

    /// The pixels as the object stores them, row by row, before any interpretation of bits: 8-bit ones widened.
    /// Throws Error{bad_input}.
    std::vector<std::uint16_t> storedPixels(int frame);

    /// Densities of a slice, row by row; kPaddingHu where nothing was measured.
    std::vector<std::int16_t> densities(const Slice& slice);

private:
    struct Opened;
    const ImageObject& object_;
    std::unique_ptr<Opened> opened_;
};

}  // namespace vicon::ingest
