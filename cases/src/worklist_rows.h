#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/cases/outbox.h"
#include "vicon/cases/worklist.h"

namespace vicon {

/// What the worklist shows of some cases, as it lies in the tables: read for all of them at once.
struct WorklistRows {
    using ScanKey = std::pair<std::string, std::string>;  ///< case and scan
    std::map<std::string, std::vector<ScanRecord>> scans;
    std::map<ScanKey, Job> jobs;
    std::map<ScanKey, std::vector<StepRecord>> steps;  ///< those whose results are shown
    std::map<std::string, int> markers;
    std::map<std::string, std::map<DeliveryState, int>> deliveries;
};
WorklistRows worklistRows(CaseStore& store, const QueueOptions& options, const std::vector<CaseRecord>& cases);

/// The cases of a page, and one more where there are more.
std::vector<CaseRecord> casesOfPage(CaseStore& store, const WorklistPageWanted& wanted);

}  // namespace vicon
