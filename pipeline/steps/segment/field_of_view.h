#pragma once

#include "segment/body.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

/// Area of the faces at which a lumen ends because the scan does: at the ends of the volume, or beside voxels where
/// nothing was measured. `inside` lies on the volume's lattice.
double lumenCut_mm2(const HuVolume& volume, const InsideVolume& inside);

/// Whether the field of view cuts the body at its sides: from a twentieth of the places at the
/// edge of what was measured, or more, a line into the scan begins in tissue.
bool bodyIsCut(const Body& body);

}  // namespace vicon::steps
