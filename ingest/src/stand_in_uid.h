#pragma once

#include <string>

#include "image_object.h"

namespace vicon::ingest {

/// A valid UID below 2.25 that stands for a text: the same text gives the same UID.
std::string standInUid(const std::string& text);

/// Gives an object whose header lacks its UIDs some that group it as its dates, numbers and patient do, and notes so
/// among its repairs.
void fillStandInUids(ImageObject& object);

}  // namespace vicon::ingest
