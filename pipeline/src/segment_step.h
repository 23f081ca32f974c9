#pragma once

#include "step_table.h"

namespace vicon::pipeline {

/// The step that finds the lumen of a scan's organ; of a colon it takes the one that a person gave, if there is one.
nlohmann::json segmentParameters(const Config& config);
nlohmann::json runSegment(const StepInputs& inputs, ScanResults& results, const StepRecords& records,
                          Progress& progress);
std::vector<std::string> segmentFiles(const nlohmann::json& result);

}  // namespace vicon::pipeline
