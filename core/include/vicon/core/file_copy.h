#pragma once

#include <filesystem>

namespace vicon {

/// Copies a file's bytes over whatever is there, readable by its owner alone. Returns 0, else the system's number for
/// what went wrong: to std::filesystem::copy_file a disk that fills on the way is an input/output error.
int copyBytes(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace vicon
