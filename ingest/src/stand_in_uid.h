#pragma once

#include "image_object.h"

namespace vicon::ingest {

/// Gives an object whose header lacks its UIDs some that group it as its dates, numbers and patient do, and notes so
/// among its repairs.
void fillStandInUids(ImageObject& object);

}  // namespace vicon::ingest
