#pragma once

#include <filesystem>

#include "vicon/core/volume.h"

namespace vicon::scan_files {

/// Whether voxels are packed with zlib in the file: labels shrink a hundredfold, densities and fields hardly.
enum class Packing { raw, zlib };

/// Writes a MetaImage (.mha, LOCAL, LPS origin and direction) that 3D Slicer and ParaView open, by replaceFile().
/// Instantiated for the voxel types of core/volume.h. Throws Error{store}.
template <class T>
void writeVolume(const std::filesystem::path& file, const Volume<T>& volume, Packing packing);

/// Reads such a file. The voxel type must be the file's own; throws Error{bad_input} otherwise, Error{not_found} when
/// there is no such file, Error{no_memory} when the voxels do not fit.
template <class T>
Volume<T> readVolume(const std::filesystem::path& file);

/// Reads only where the voxels lie.
Grid readGrid(const std::filesystem::path& file);

}  // namespace vicon::scan_files
