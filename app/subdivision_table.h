#pragma once

#include <string>

#include "vicon/cases/worklist.h"
#include "vicon/core/options.h"

namespace vicon::app {

/// Prints the thesis' Table 2 of every scan of the case that has been divided: minutes for a real scan. Returns the
/// exit code.
/// @param scan_id only scans whose id begins so
int printSubdivisionTable(CaseStore& store, const Config& config, const WorklistCase& of, const std::string& scan_id);

}  // namespace vicon::app
