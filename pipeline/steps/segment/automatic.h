#pragma once

#include "vicon/core/progress.h"
#include "vicon/steps/segment.h"

namespace vicon::steps {

/// Method "auto" of segmentColon(): gas and tagged fluid of the whole colon.
Segmentation segmentAutomatically(const HuVolume& volume, Vector3 gravity, const SegmentOptions& options,
                                  Progress& progress);

}  // namespace vicon::steps
