#pragma once

#include <filesystem>

namespace vicon::ingest {

/// Whether two files hold the same DICOM object: the same data set, whatever their meta headers say, and however
/// lengths and, where nothing is compressed, value representations are written. What cannot be read is not the same.
bool isSameObject(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace vicon::ingest
