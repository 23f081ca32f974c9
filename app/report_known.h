#pragma once

#include "vicon/cases/case_store.h"
#include "vicon/cases/known_study.h"

namespace vicon::app {

/// What the images of a case, its order and the steps say of it; who reads it adds how long that took and what was
/// seen.
KnownStudy knownOf(CaseStore& store, const std::string& case_id);

}  // namespace vicon::app
