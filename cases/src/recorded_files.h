#pragma once

#include <set>
#include <vector>

#include "vicon/cases/backup.h"

namespace vicon {

/// The files that rows of the database speak of and that are not there. Throws Error{database}, Error{cancelled}.
/// @param of_cases looks only at these; "" stands for the earlier reports kept of patients. Empty: at all.
std::vector<FileFault> missingFiles(CaseStore& store, Progress& progress, const std::set<std::string>& of_cases = {});

/// The same, and those whose content is not what their row says.
std::vector<FileFault> faultyFiles(CaseStore& store, Progress& progress);

}  // namespace vicon
