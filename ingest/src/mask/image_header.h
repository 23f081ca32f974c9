#pragma once

#include <array>
#include <cstdint>
#include <filesystem>

#include "vicon/core/geometry.h"
#include "vicon/ingest/mask_file.h"

namespace vicon::ingest {

enum class VoxelType { u8, i8, u16, i16, u32, i32, u64, i64, f32, f64 };
std::size_t bytesOf(VoxelType type);

/// What the header of an image file says: where its voxels lie in the patient, and how they lie in the file.
struct ImageHeader {
    MaskForm form = MaskForm::nifti;
    Grid grid;
    VoxelType type = VoxelType::u8;
    bool big_endian = false;
    double slope = 1, intercept = 0;  ///< value = slope x stored + intercept
    std::filesystem::path voxel_file;
    std::uint64_t begin = 0;  ///< in that file: of the voxels, or of the packed stream
    std::uint64_t skip = 0;   ///< bytes of the unpacked stream before the voxels
    bool packed = false;      ///< by zlib or gzip
};

/// How an image file places its voxels: LPS mm.
struct Placement {
    std::array<std::int64_t, 3> size{};
    Point3 first_mm;                 ///< of the first voxel's centre
    std::array<Vector3, 3> step_mm;  ///< from voxel to voxel along each axis
};
/// Throws Error{bad_input} where that is no lattice of boxes: axes that are not orthogonal, sizes below 1 or over
/// 65535, steps below 0.01 or over 20 mm, farther than 10 m from the origin, or more than `largest_mvoxel`.
Grid latticeOf(const Placement& placement, double largest_mvoxel, const std::filesystem::path& file);

/// Each reads one form's header. Throws Error{bad_input}.
ImageHeader readNiftiHeader(const std::filesystem::path& file, double largest_mvoxel);
ImageHeader readNrrdHeader(const std::filesystem::path& file, double largest_mvoxel);
ImageHeader readMetaImageHeader(const std::filesystem::path& file, double largest_mvoxel);

}  // namespace vicon::ingest
