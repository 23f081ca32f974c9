#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace vicon::steps {

/// Writes 8-bit RGBA rows as PNG with one text chunk, by replaceFile(). Throws Error{store}.
void writePng(const std::filesystem::path& file, int width, int height, const std::vector<std::uint8_t>& rgba,
              const std::string& keyword, const std::string& text);

}  // namespace vicon::steps
