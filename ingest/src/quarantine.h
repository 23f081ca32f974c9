#pragma once

#include <string>
#include <vector>

#include "image_object.h"
#include "import_reporter.h"

namespace vicon::ingest {

/// Keeps objects that name another patient than their study's case, a folder a patient, until a person looks at them.
void quarantine(const ImportContext& context, const CaseRecord& of_case, const std::vector<ImageObject>& strangers);

}  // namespace vicon::ingest
