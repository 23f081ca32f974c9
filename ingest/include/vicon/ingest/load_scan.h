#pragma once

#include <filesystem>

#include "vicon/core/progress.h"
#include "vicon/core/volume.h"
#include "vicon/ingest/import.h"

namespace vicon::ingest {

/// Decodes the slices of a stored scan into densities.
///
/// The grid is orthonormal, right-handed, in LPS mm; its axes are the scan's own, in the order and direction that come
/// closest to left, posterior, superior, whatever order and direction the slices were stored in. A gantry tilt is
/// removed by shifting each slice in its plane (linear interpolation). Missing slices within the limits of `options`
/// are interpolated linearly. What was not measured is kPaddingHu.
///
/// @param dicom_folder STORE/cases/CASE/SCAN/dicom
/// @throws Error{bad_input} naming the file or the reason when the slices make no volume, Error{no_memory},
///         Error{cancelled}
HuVolume loadScan(const std::filesystem::path& dicom_folder, const ImportOptions& options, Progress& progress);

}  // namespace vicon::ingest
