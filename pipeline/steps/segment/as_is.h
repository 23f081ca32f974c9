#pragma once

#include "vicon/core/progress.h"
#include "vicon/steps/segment.h"

namespace vicon::steps {

/// segmentColon(), with a lumen segmentGivenColon(), of densities that are taken as they are: nothing is softened.
/// @param given none: the lumen is sought
Segmentation segmentAsIs(const HuVolume& volume, const InsideVolume* given, Vector3 gravity,
                         const SegmentOptions& options, Progress& progress);

}  // namespace vicon::steps
