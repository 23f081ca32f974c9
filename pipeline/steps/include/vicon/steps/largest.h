#pragma once

#include "vicon/core/volume.h"

namespace vicon::steps {

/// The largest of a field's values; 0 of none.
float largestOf(const FieldVolume& field);

}  // namespace vicon::steps
