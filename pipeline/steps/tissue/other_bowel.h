#pragma once

#include <cstddef>
#include <vector>

#include "grid/run_labels.h"
#include "vicon/steps/tissue.h"

namespace vicon::steps {

/// Voxels of the labels that are no lumen of the colon but of tagged bowel that touches it, in order: fluid without gas
/// that hangs together with its piece only where the wall between them is thin, and that has no wall of its own where
/// the labels end, because they were cut off there.
/// @param pieces of the labels, over faces
std::vector<std::size_t> otherBowel(const TissueVolume& tissue, const InsideVolume& inside, const RunLabels& pieces);

}  // namespace vicon::steps
