#pragma once

#include "lumen_field.h"
#include "scene.h"
#include "vicon/core/progress.h"
#include "vicon/phantom/phantom.h"

namespace vicon::phantom {

/// The patient on the table as an ideal scanner without blur and noise would see him: each voxel holds the mean density
/// of what lies in it (to first order from the distances to the surfaces).
HuVolume paintScene(const Grid& grid, const Scene& scene, const LumenField& field, const PhantomTruth& truth,
                    Progress& progress);

/// The lumen's labels: voxels whose centre lies in gas or fluid of the colon and not in the catheter.
InsideVolume labelLumen(const Grid& grid, const Scene& scene, const LumenField& field, const PhantomTruth& truth);

}  // namespace vicon::phantom
