#pragma once

#include <vector>

#include "segment/fluid/levels.h"

namespace vicon::steps {

/// Closes the partial-volume layer between gas and fluid, which passes through the densities of tissue: in the columns
/// of the contacts from gas to fluid, and up to three voxels beside them, where the wall is near, by interpolation of
/// the lumen's shape between the gas above the layer and the fluid below it. Fills only what has no label yet, and
/// no voxel that is nearer to `tissue_hu` than the blur of the level can make it: thin folds in the layer stay.
void closeFluidLayer(const HuVolume& volume, Down down, const std::vector<ContactPatch>& patches, double tissue_hu,
                     InsideVolume& labels);

}  // namespace vicon::steps
