#pragma once

#include "vicon/cases/marker_measures.h"
#include "vicon/core/volume_view.h"

namespace vicon {

/// Takes the voxels whose middles lie within `radius_mm` of `centre`, in tissue alone. A voxel beside the lumen has a
/// density between that of the tissue and that of the gas or tagged fluid, so a margin of 2 mm and at least 1.5 voxels
/// is kept to the lumen's border; where a small finding has fewer than DensitySample::kLeastVoxels then, one of 1.5
/// voxels; where it still has, no voxels are given. Padding is left out. `inside` may cover a part of the volume only:
/// there is no lumen beyond it. Throws Error{wrong_use} for a radius outside 0.5 to 25 mm.
DensitySample sampleDensity(const HuView& volume, const InsideView& inside, Point3 centre, double radius_mm);

}  // namespace vicon
