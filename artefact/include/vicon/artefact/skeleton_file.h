#pragma once

#include <filesystem>
#include <vector>

#include "vicon/core/skeleton.h"

namespace vicon::artefact {

/// Writes `skeleton.vtp`: one polyline per piece, in order; point arrays station_mm, radius_mm; cell array bridge.
void writeSkeleton(const std::filesystem::path& file, const Skeleton& skeleton);
/// Reads it back. Throws Error{not_found} or Error{bad_input}.
Skeleton readSkeleton(const std::filesystem::path& file);

/// The thesis' 26-connected path: voxel centres in order from the rectum, one list per connected piece.
using SkeletonVoxels = std::vector<std::vector<Point3>>;
void writeSkeletonVoxels(const std::filesystem::path& file, const SkeletonVoxels& paths);
SkeletonVoxels readSkeletonVoxels(const std::filesystem::path& file);

}  // namespace vicon::artefact
