#pragma once

#include <future>

#include "step_table.h"

namespace vicon::pipeline {

/// Whether the wall is contoured from the fraction of tissue, and not from labels and densities.
bool wallFromTissue(const Config& config);
/// The wall, by either.
std::shared_future<steps::LumenSurface> surfaceOf(const Config& config, ScanResults& results);

/// The step that tells how much of each voxel in and around the lumen is tissue.
nlohmann::json tissueParameters(const Config& config);
nlohmann::json runTissue(const StepInputs& inputs, ScanResults& results, const StepRecords& records,
                         Progress& progress);
std::vector<std::string> tissueFiles(const nlohmann::json& result);

}  // namespace vicon::pipeline
