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

/// Whether a file's header is as plain as those that ITK and VICON write: printed characters, nothing said twice, three
/// dimensions, the voxels in the same file, as binary numbers, the lowest byte first. MetaIO reads two thousand million
/// numbers where it is told so, copies long values over the end of its fields, and divides by nothing where voxels are
/// said to lie in files of numbered names.
bool isPlainHeader(const std::filesystem::path& file);

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
