#pragma once

#include <filesystem>

namespace vicon::scan_files {

/// Whether the header of a .vtp is one that writePolyData() writes, and the file holds the bytes of each array that it
/// names. VTK's reader (seen in 9.1) takes a header at its word, and writes beyond the arrays of one that lies.
bool isSoundVtp(const std::filesystem::path& file);

}  // namespace vicon::scan_files
