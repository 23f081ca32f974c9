#pragma once

#include "lumen_field.h"
#include "scene.h"
#include "vicon/core/progress.h"
#include "vicon/phantom/phantom.h"

namespace vicon::phantom {

/// The lumen's voxels, rounded off until they have the lumen's own topology; where that finds no end, voxels that touch
/// others by a corner alone are put in as well as taken out. The field follows. Of a colon that does not lie within the
/// grid as a whole they are what they are. Throws Error{internal} where the voxels cannot show the lumen, and
/// Error{cancelled}.
InsideVolume soundLumen(const Grid& grid, const Scene& scene, LumenField& field, const PhantomTruth& truth,
                        Progress& progress);

}  // namespace vicon::phantom
