#pragma once

#include <filesystem>
#include <vector>

#include "vicon/core/skeleton.h"
#include "vicon/core/skeleton_tree.h"

namespace vicon::scan_files {

/// Writes `skeleton.vtp`: one polyline per piece, in order; point arrays station_mm, radius_mm; cell array bridge.
void writeSkeleton(const std::filesystem::path& file, const Skeleton& skeleton);
/// Writes the `skeleton.vtp` of a cavity, which no path leads through: no line, and the widest place as a point.
void writeNoPath(const std::filesystem::path& file, const SkeletonPoint& widest);
/// Reads it back; of a tree the way from its root to the tip that lies farthest from it, of a cavity an empty one.
/// Throws Error{not_found} or Error{bad_input}.
Skeleton readSkeleton(const std::filesystem::path& file);

/// Writes the skeleton of an organ that branches: one polyline per branch, in the tree's order; besides the arrays
/// above the cell arrays `branch` (its number), `parent` (-1 for the root's) and `generation`.
void writeSkeletonTree(const std::filesystem::path& file, const SkeletonTree& tree);
/// Reads it back; no branches when the file holds the skeleton of one path.
/// Throws Error{not_found} or Error{bad_input}.
SkeletonTree readSkeletonTree(const std::filesystem::path& file);

void writeSkeletonVoxels(const std::filesystem::path& file, const SkeletonVoxels& paths);
SkeletonVoxels readSkeletonVoxels(const std::filesystem::path& file);

}  // namespace vicon::scan_files
