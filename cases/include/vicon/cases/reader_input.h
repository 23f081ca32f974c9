#pragma once

#include "vicon/cases/case_store.h"

namespace vicon {

/// Whether a person has said something about a scan, or a report tells of it: it has markers, corrections, a given
/// lumen or reviews of bridges, or it is a scan (role "scan") of a case with a report. Nothing that arrives may then
/// change what it shows. Throws Error{database}.
bool hasReaderInput(CaseStore& store, const ScanRecord& scan);

}  // namespace vicon
