#pragma once

#include "vicon/core/progress.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

/// The wall distance as if the rectal tube were lumen, where that makes a difference: on a box of the lattice of
/// `inside` about the tube, empty where there is none. The middle of the rectum does not lie beside its tube. A tube is
/// what lumen surrounds in an axial slice not far from the rectal end. The same, bit for bit, as of the whole grid.
FieldVolume wallDistanceOverTube(const InsideVolume& inside, Point3 rectal_end_mm, Progress& progress);

}  // namespace vicon::steps
