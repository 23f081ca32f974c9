#pragma once

#include "vicon/core/progress.h"
#include "vicon/steps/segment.h"

namespace vicon::steps {

/// Method "auto" of segmentColon(): gas and tagged fluid of the whole colon.
Segmentation segmentAutomatically(const HuVolume& volume, Vector3 gravity, const SegmentOptions& options,
                                  Progress& progress);

/// The same stages with the gas and fluid of a given lumen, as segmentGivenColon() has it.
Segmentation segmentGiven(const HuVolume& volume, const InsideVolume& given, Vector3 gravity,
                          const SegmentOptions& options, Progress& progress);

}  // namespace vicon::steps
