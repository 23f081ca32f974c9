#pragma once

#include <string>

#include "vicon/cases/case_store.h"

namespace vicon::ingest {

/// The version of a case's report that was signed last; 0: none.
int signedVersion(CaseStore& store, const std::string& case_id);

}  // namespace vicon::ingest
