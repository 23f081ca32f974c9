#pragma once

#include "step_table.h"

namespace vicon::pipeline {

/// The skeleton of a colon, a tree of an organ that branches, or of a cavity the file that says that it has none.
nlohmann::json runSkeleton(const StepInputs& inputs, ScanResults& results, const StepRecords& records,
                           Progress& progress);
std::vector<std::string> skeletonFiles(const nlohmann::json& result);

}  // namespace vicon::pipeline
