#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/core/options.h"

namespace vicon::app {

/// A scan as the worklist shows it.
struct WorklistScan {
    ScanRecord record;
    std::string state;  ///< queued, running, done, failed; "kept" when it is not for the pipeline
    std::string step;
    double progress = 0;
    std::string folder;
    std::string reason;  ///< why it failed, or the pipeline's verdict
};

/// A case as the worklist shows it.
struct WorklistCase {
    CaseRecord record;
    std::string state;  ///< failed, running, queued, done, or kept: the first of these that any scan is in
    std::string reason;
    std::vector<WorklistScan> scans;
    int markers = 0;
};

std::vector<WorklistCase> makeWorklist(CaseStore& store, const Config& config);
WorklistCase makeWorklistCase(CaseStore& store, const Config& config, const CaseRecord& record);

/// {"cases":[{"id","patient","study_uid","state","scans":[{"id","series_uid","position","state","folder"}]}]} and more
/// keys.
nlohmann::json toJson(const std::vector<WorklistCase>& worklist);

}  // namespace vicon::app
