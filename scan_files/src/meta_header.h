#pragma once

#include <filesystem>
#include <string>

#include "vicon/core/geometry.h"

namespace vicon::scan_files {

/// Voxels in a file are mapped, so they begin where any type and any vector instruction may read.
constexpr std::size_t kVoxelAlignment = 64;

/// The header of a MetaImage whose raw voxels follow in the same file, a multiple of kVoxelAlignment bytes long.
/// @param type the format's name of the voxel type, "MET_SHORT"
std::string rawHeader(const Grid& grid, const std::string& type);

/// Whether a file has a header that says three dimensions wherever it says how many, and that the voxels follow in it.
/// MetaIO does not ask whether it can be: it reads two thousand million numbers of a line where it is told so, and
/// divides by nothing where the voxels are said to lie in files of numbered names.
bool saysThreeDimensionsInOneFile(const std::filesystem::path& file);

/// Where the voxels of such a file lie.
struct VoxelBytes {
    std::size_t begin = 0;
    std::size_t count = 0;
    bool packed = false;
};
/// Throws Error{bad_input} when they lie in another file, or the file is too short for them, also when they are packed:
/// memory is asked for after this.
/// @param raw_bytes how many they are when they are not packed
VoxelBytes voxelBytesIn(const std::filesystem::path& file, std::size_t raw_bytes);

}  // namespace vicon::scan_files
