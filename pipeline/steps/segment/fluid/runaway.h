#pragma once

#include <vector>

#include "segment/fluid/levels.h"

namespace vicon::steps {

/// Takes away what floods from a pool out of the scan: no bowel leaves a scan of the colon full to the brim, but bone
/// does that a pool touches without a wall between. Of such a flood what lies near its levels and is as dense as they
/// are stays.
/// @return millilitres that were taken
double cutRunaways(const HuVolume& volume, Down down, const std::vector<ContactPatch>& patches, InsideVolume& labels);

}  // namespace vicon::steps
