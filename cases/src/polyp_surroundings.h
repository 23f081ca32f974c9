#pragma once

#include <string>

#include "traced_polyp.h"
#include "vicon/core/volume_view.h"

namespace vicon {

/// Whether another polyp begins where this one ends.
/// @param width_mm of this one
bool touchesAnother(const TracedPolyp& polyp, double width_mm);

/// Why an outline within fluid is not to be trusted: its edge there was made out against tagging. Empty where it is
/// hardly in any.
std::string fluidTrouble(const TracedPolyp& polyp, const InsideView& lumen);

}  // namespace vicon
