#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace vicon::report {

/// A decoded picture: `channels` (1 grey, 3 RGB) bytes a pixel, rows from the top.
struct Picture {
    int width = 0;
    int height = 0;
    int channels = 3;
    std::vector<std::uint8_t> pixels;
};

/// Reads a PNG of any kind; what is transparent is put on white. A picture whose pixels are all grey comes with one
/// channel. Throws Error{not_found} or Error{bad_input}.
Picture readPng(const std::filesystem::path& file);

/// The same picture with at most `max_width` pixels a row: each pixel the mean of those it covers.
Picture reduced(Picture picture, int max_width);

}  // namespace vicon::report
