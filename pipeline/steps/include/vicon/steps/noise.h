#pragma once

#include "vicon/core/volume.h"

namespace vicon::steps {

/// The most frequent standard deviation, in HU, among cubes of about 8 mm whose mean lies between 0 and 100 HU (soft
/// tissue); organs with vessels or edges in them are seldom alike, homogeneous ones are. 0 where fewer than 20 cubes
/// qualify. The method is Christianson's global noise level (AJR 2015) on cubes instead of discs.
double softTissueNoise(const HuVolume& hu);

}  // namespace vicon::steps
