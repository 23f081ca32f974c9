#pragma once

#include <vector>

#include "segment/body.h"
#include "vicon/steps/segment.h"

namespace vicon::steps {

/// Sets verdict, confidence and reason from the plan and from where it lies in the body.
void judgeSegmentation(Segmentation& result, const SegmentOptions& options, const Body& body, double lumen_cut_mm2);

/// A result without the organ: it is absent, for this reason.
Segmentation organAbsent(const std::string& reason);

/// Adds what a person should know to the reason.
void note(Segmentation& result, const std::string& what);

}  // namespace vicon::steps
