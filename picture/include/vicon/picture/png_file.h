#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace vicon::picture {

/// A decoded picture: `channels` (1 grey, 3 RGB, 4 RGBA) bytes a pixel, rows from the top.
struct Picture {
    int width = 0, height = 0;
    int channels = 3;
    std::vector<std::uint8_t> pixels;
};
/// One that several threads read.
using SharedPicture = std::shared_ptr<const Picture>;

struct PngOptions {
    int compression = 6;        ///< zlib's level, 0 to 9
    bool says_srgb = false;     ///< with a chunk that says which colours are meant
    std::string keyword, text;  ///< of a text chunk; none where the keyword is empty
};

/// Writes 8-bit pixels, rows from the top, by replaceFile(); 1, 3 or 4 channels, by their number. Throws Error{store}.
void writePng(const std::filesystem::path& file, int width, int height, std::span<const std::uint8_t> pixels,
              const PngOptions& options = {});

/// Reads a PNG of any kind as RGB (3 channels; what is transparent is put on white) or RGBA (4). Throws
/// Error{not_found}, and Error{bad_input} when it is damaged or claims more pixels than any picture of VICON has.
Picture readPng(const std::filesystem::path& file, int channels = 3);

}  // namespace vicon::picture
