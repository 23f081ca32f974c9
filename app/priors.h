#pragma once

#include <string>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/cases/prior_report.h"

namespace vicon::app {

/// Signed reports of the store's own cases, and those that came from elsewhere: of the same patient ID, name and birth
/// date, about an examination of an earlier day. One whose name or birth date differs is left out and said.
PriorList priorsOf(CaseStore& store, const std::string& case_id);

/// The scans of a report's study that this store has: what the report does not say of its images, they say.
std::vector<PriorScan> imagedScans(CaseStore& store, const PriorReport& report);

/// Throws Error{not_found}. @param sop_uid or the number that a list of them shows it by, from 1
const PriorReport& requirePrior(const PriorList& priors, const std::string& sop_uid);

}  // namespace vicon::app
