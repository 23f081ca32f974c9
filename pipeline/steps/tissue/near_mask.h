#pragma once

#include <cstdint>
#include <vector>

#include "vicon/core/volume.h"

namespace vicon::steps {

/// 1 in every voxel that has one within `reach` voxels along each axis whose label is `label`, or any label but outside
/// where `label` is kOutside; 0 elsewhere.
std::vector<std::uint8_t> nearMask(const InsideVolume& inside, std::uint8_t label, int reach);

}  // namespace vicon::steps
