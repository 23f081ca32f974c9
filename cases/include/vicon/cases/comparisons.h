#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/cases/growth.h"
#include "vicon/cases/prior_report.h"

namespace vicon {

// What a reader said of a finding and one of an earlier report. Kept with what that report said then, so that nothing
// that is read otherwise later alters it. Every change is one transaction with a line of the audit trail; none is made
// while the report is signed and no amendment was begun: then they throw Error{wrong_use}.

struct Comparison {
    std::string finding_id;
    bool confirmed = true;  ///< they are one thing; else the reader said that they are not
    std::string report_uid, report_class, report_series_uid, study_uid;  ///< the structured report, and of what study
    std::string maker;
    std::string prior_uid, prior_name;
    std::string prior_what;   ///< "polyp", or in the report's words
    std::string prior_place;  ///< "sigmoid", or in the report's words; empty: not said
    MeasuredSize before;
    std::string person, at;  ///< who said so, when (UTC)
};
nlohmann::json toJson(const Comparison& comparison);
/// Throws Error{bad_input}.
Comparison comparisonFromJson(const nlohmann::json& json);

/// @param known scans of the store, for what the report itself does not say of its images
Comparison comparisonWith(const std::string& finding_id, const PriorReport& report, const PriorFinding& prior,
                          const std::vector<PriorScan>& known);

/// In order of their findings' numbers.
std::vector<Comparison> comparisons(CaseStore& store, const std::string& case_id);
/// The one of this finding and that of the report; nothing where the reader said nothing of them.
std::optional<Comparison> findComparison(CaseStore& store, const std::string& case_id, const std::string& finding_id,
                                         const std::string& report_uid, const std::string& prior_uid);
/// Keeps `after` in place of `before`; nothing: there is none. Returns it as kept. Throws Error{bad_input} when what is
/// stored is no longer `before`, or either finding is confirmed to be another one of the same reports; Error{not_found}
/// when the case has no such finding.
std::optional<Comparison> editComparison(CaseStore& store, const std::string& case_id,
                                         const std::optional<Comparison>& before, std::optional<Comparison> after);

/// The size of a finding of today, and how it was measured.
MeasuredSize measuredSizeOf(const Finding& finding, const FindingFacts& facts, const std::vector<ScanRecord>& scans,
                            const Study& study);

/// A comparison with what follows from it.
struct ComparedFinding {
    Comparison said;
    MeasuredSize now;
    Growth growth;
};

}  // namespace vicon
