#pragma once

#include <filesystem>
#include <optional>

#include "vicon/ingest/mask_file.h"

namespace vicon::ingest {

/// Reads a DICOM Segmentation (PS3.3 A.51): BINARY, or FRACTIONAL cut at one half, uncompressed or deflated. Its frames
/// must lie in one even stack; where it has none, the segment is not. The digest is not filled in. Throws as
/// readMask().
MaskFile readSegmentationObject(const std::filesystem::path& file, std::optional<int> label, double largest_mvoxel,
                                Progress& progress);

}  // namespace vicon::ingest
