#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scan_results.h"
#include "vicon/cases/given_lumen.h"
#include "vicon/cases/records.h"
#include "vicon/core/options.h"
#include "vicon/core/quantity.h"
#include "vicon/pipeline/scan_work.h"

namespace vicon::pipeline {

/// What does not change during the work on a scan.
struct StepInputs {
    Config config;
    AcquiredVolumeLoader loader;
    Vector3 gravity;
    std::filesystem::path dicom_folder;
    std::optional<GivenLumen> lumen;  ///< instead of the one that would be found
    Quantity quantity = Quantity::density;
};

using StepRecords = std::map<std::string, StepRecord>;

/// What a step reads of the densities.
enum class Densities { none, around_lumen, whole };

/// One checkpoint of the pipeline.
struct Step {
    std::string name;
    int version;                      ///< raise it whenever the step's code gives other results
    double from, to;                  ///< its part of the job's progress, 0 to 1, as measured on a 512 x 512 x 430 scan
    std::vector<std::string> inputs;  ///< steps whose results it uses; none: it reads the DICOM instances
    Densities densities;              ///< what it needs is kept in memory until it ends
    std::function<std::vector<std::string>(const nlohmann::json& result)> outputs;  ///< its files in the scan's folder
    std::function<nlohmann::json(const Config&)> parameters;
    /// Does the work, writes the files, and returns the measures for scan.json.
    std::function<nlohmann::json(const StepInputs&, ScanResults&, const StepRecords&, Progress&)> run;
};

/// The steps in order.
const std::vector<Step>& stepTable();

}  // namespace vicon::pipeline
