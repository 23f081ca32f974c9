#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace vicon::scan_files {

/// Writes 8-bit RGBA rows as PNG with one text chunk, by replaceFile(). Throws Error{store}.
void writePng(const std::filesystem::path& file, int width, int height, const std::vector<std::uint8_t>& rgba,
              const std::string& keyword, const std::string& text);

/// Reads such a file's pixels. Throws Error{not_found}, Error{bad_input} when it is damaged or of another size.
std::vector<std::uint8_t> readPng(const std::filesystem::path& file, int width, int height);

}  // namespace vicon::scan_files
