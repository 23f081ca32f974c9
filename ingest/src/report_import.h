#pragma once

#include "image_object.h"
#include "import_reporter.h"

namespace vicon::ingest {

/// Keeps a measurement report (TID 1500) as it came, for later studies of its patient. Another structured report is set
/// aside; one that cannot be read is refused. Killed at any moment and done again, it ends in the same state.
/// @param object with its file, as it was inspected
/// @param shown how the user knows the file
/// @param unpacked out of a zip file: nobody else has it
void takeReport(const ImageObject& object, const std::string& shown, bool unpacked, const ImportContext& context);

}  // namespace vicon::ingest
