#pragma once

#include <string>

#include "dataset.h"
#include "image_object.h"
#include "vicon/ingest/import.h"

namespace vicon::ingest {

/// Reads how the pixels are stored into `object`; returns what is wrong with them, empty when nothing is.
std::string readPixelFormat(const Dataset& dataset, const ImportOptions& options, ImageObject& object);

/// Whether the pixels went through a lossy compression at some time.
bool isLossy(const Dataset& dataset, const std::string& transfer_syntax);

}  // namespace vicon::ingest
