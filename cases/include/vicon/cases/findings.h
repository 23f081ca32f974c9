#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/assessment.h"
#include "vicon/cases/case_store.h"
#include "vicon/cases/finding.h"

namespace vicon {

// The findings of a case and what is said of the whole study, as the database keeps them. Every change is one
// transaction with a line of the audit trail that holds what was before and what is after it. Nothing is changed while
// the report is signed and no amendment was begun: then they throw Error{wrong_use}.

/// In order of their numbers.
std::vector<Finding> findings(CaseStore& store, const std::string& case_id);
/// Takes "f3" or "3". Throws Error{not_found}.
Finding requireFinding(CaseStore& store, const std::string& case_id, const std::string& finding_id);

/// What shall become of one finding: `before` as the reader saw it (nothing: it is new), `after` as it shall be
/// (nothing: it is removed).
struct FindingEdit {
    std::optional<Finding> before, after;
};
/// All of these edits, or none. A new finding gets its id; every edit its times. Returns them as saved. Throws
/// Error{bad_input} when a stored finding is no longer what the reader saw, or a marker of it belongs to another one,
/// and Error{not_found} for a new marker that the case does not have.
std::vector<FindingEdit> editFindings(CaseStore& store, const std::string& case_id, std::vector<FindingEdit> edits);

/// The markers and those that they are paired with: all show the same finding. Throws Error{not_found}.
std::vector<std::string> withPartners(CaseStore& store, const std::string& case_id,
                                      const std::vector<std::string>& marker_ids);

/// Empty where nothing was said yet.
Assessment assessmentOf(CaseStore& store, const std::string& case_id);
/// Throws Error{bad_input} when the stored one is no longer `before`.
void saveAssessment(CaseStore& store, const std::string& case_id, const Assessment& before, const Assessment& after);

}  // namespace vicon
