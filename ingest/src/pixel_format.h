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

bool isJpeg2000(const std::string& transfer_syntax);

/// Whether GDCM decodes these pixels: JPEG 2000, which DCMTK as packaged does not know, and JPEG-LS, where DCMTK 3.6.7
/// on Debian calls CharLS 2.4 without one of its arguments and so writes to an arbitrary address (found with valgrind).
bool isDecodedByGdcm(const std::string& transfer_syntax);

}  // namespace vicon::ingest
