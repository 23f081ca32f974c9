#pragma once

#include "vicon/core/volume.h"

namespace vicon::steps {

/// Fills what noise leaves open inside a pool: small sets of outside voxels (over faces) that only lumen surrounds. A
/// polyp or a fold hangs on the wall and stays; so does what floats and is larger.
void fillFluidSpecks(InsideVolume& labels);

}  // namespace vicon::steps
