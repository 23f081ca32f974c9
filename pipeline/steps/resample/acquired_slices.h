#pragma once

#include "grid/itk_view.h"
#include "resample/oriented_scan.h"
#include "resample/sampling.h"

namespace vicon::steps {

/// Slices of a scan along its oriented axes, as an image that begins at index 0. Nothing is copied where the scan is
/// stored so; otherwise ITK's filters permute and flip these slices alone.
ItkHu::Pointer acquiredSlices(const OrientedScan& scan, SliceRange range);

}  // namespace vicon::steps
