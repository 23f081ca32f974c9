#pragma once

#include <functional>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/core/options.h"
#include "vicon/core/volume.h"
#include "vicon/pipeline/worker.h"

namespace vicon::pipeline {

/// Decodes a scan's dicom/ folder into HU. `app` gives it, because this room does not know DICOM.
using AcquiredVolumeLoader = std::function<HuVolume(const std::filesystem::path& dicom_folder, Progress&)>;

struct StepOptions {
    int at_once = 3;
    double memory_mb = 0;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("work.steps_at_once", at_once, "",
          "Steps of a scan that may run, or be written to the disk, at the same time; 1 needs the least memory.",
          {1, 16});
        v("work.memory_mb", memory_mb, "MB",
          "A scan that needs more memory than this is not begun; 0: as much as the machine and the process may have.",
          {0, 1e9});
    }
};

/// All options of the steps, for Config::declare().
std::vector<OptionSpec> stepOptionSpecs();

/// The work on one scan: resample, segment, skeleton, subdivide, potential. Each step is a checkpoint: it is done again
/// only when its parameters, its code's version, its inputs or its files changed. A scan without a colon ends after
/// `segment`, with the verdict in scan.json.
/// @param loader_parameters what of the configuration `loader` depends on, for the record of the first step
JobWork makeScanWork(CaseStore& store, const Config& config, AcquiredVolumeLoader loader,
                     nlohmann::json loader_parameters);

/// Whether the work on a scan, done now, would redo anything: parameters, code, instances or files are not what its
/// steps were made with.
bool isOutdated(CaseStore& store, const Config& config, const nlohmann::json& loader_parameters,
                const std::string& case_id, const std::string& scan_id);

}  // namespace vicon::pipeline
