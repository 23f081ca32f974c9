#pragma once

#include "vicon/core/corrections.h"
#include "vicon/core/options.h"

namespace vicon::pipeline {

/// The configuration with a scan's corrections added to segment.add, .cut and .drop; the same one when there are none.
Config withCorrections(Config config, const Corrections& corrections);

}  // namespace vicon::pipeline
