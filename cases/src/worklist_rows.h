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
    std::map<std::string, int> reports;
    std::map<std::string, std::map<DeliveryState, int>> deliveries;
};
WorklistRows worklistRows(CaseStore& store, const QueueOptions& options, const std::vector<CaseRecord>& cases);

/// Of what a word finds, or of the jobs in a state.
inline constexpr int kMostLookedAt = 2000;

/// The cases of a page, at most `most` of them. Where a state is wanted: those that may be in it.
std::vector<CaseRecord> casesOfPage(CaseStore& store, const WorklistPageWanted& wanted, int most);

}  // namespace vicon
