#pragma once

#include <cstdint>

#include "vicon/core/volume.h"

namespace vicon::steps {

/// Sets to 1 whatever a slice's border cannot reach over 4-connected zeros, in each slice; everything else to 0.
void fillSlices(Volume<std::uint8_t>& mask);

}  // namespace vicon::steps
