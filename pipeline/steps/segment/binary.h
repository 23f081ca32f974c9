#pragma once

#include "vicon/steps/segment.h"

namespace vicon::steps {

/// The thesis' binary segmentation: the 6-connected set of voxels below the iso value around the seed point; without a
/// seed point the largest such set inside the body.
Segmentation segmentBinary(const HuVolume& volume, const SegmentOptions& options, Progress& progress);

}  // namespace vicon::steps
