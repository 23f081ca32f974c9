#pragma once

#include "vicon/core/progress.h"
#include "vicon/scan_files/stored_volume.h"

namespace vicon::viewer {

/// Reads each page of a stored field that a camera in the lumen may ask for, and no other, on all cores: whoever asks
/// later does not wait for the disk. Fields of another grid are left alone. Throws Error{cancelled} where
/// `progress` is.
void bringInLumen(const scan_files::StoredVolume<float>& field, const InsideView& inside,
                  const Progress* progress = nullptr);

}  // namespace vicon::viewer
