#pragma once

#include "step_table.h"
#include "vicon/steps/organ.h"
#include "vicon/steps/segment.h"

namespace vicon::pipeline {

/// The lumen of a scan's organ: of a colon the one that a person gave, if there is one. Throws Error{bad_input} where
/// that is lost or damaged.
steps::Segmentation segmentScan(const StepInputs& inputs, const steps::OrganOptions& organ, const HuVolume& volume,
                                Progress& progress);

}  // namespace vicon::pipeline
