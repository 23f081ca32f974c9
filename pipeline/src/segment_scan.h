#pragma once

#include <optional>

#include "step_table.h"
#include "vicon/steps/organ.h"
#include "vicon/steps/segment.h"

namespace vicon::pipeline {

struct SegmentedScan {
    steps::Segmentation found;
    std::optional<HuVolume> lumen_scale;  ///< of a scan of signal, see steps::onLumenScale()
};

/// The lumen of a scan's organ: of a colon the one that a person gave, if there is one. Throws Error{bad_input} where
/// that is lost or damaged.
SegmentedScan segmentScan(const StepInputs& inputs, const steps::OrganOptions& organ, const HuVolume& volume,
                          Progress& progress);

}  // namespace vicon::pipeline
