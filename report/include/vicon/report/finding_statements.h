#pragma once

#include <string>
#include <vector>

#include "vicon/cases/report_content.h"
#include "vicon/cases/report_versions.h"
#include "vicon/report/statements.h"

namespace vicon::report {

// What a report says of findings and of the whole study, in every form.

inline constexpr const char* kNoFindings = "No findings were stated in this case.";

/// As a reader calls a scan: "supine (series 3)"; its id where the case has no such scan.
std::string scanLabel(const ReadCase& read, const std::string& scan_id);

/// "polyp, sessile", "polyp, flat, soft tissue".
std::string kindWords(const Finding& finding);
/// "7.3 mm"; "not measured".
std::string sizeWords(const FindingFacts& facts);
/// "sigmoid, 4 o'clock"; empty where neither is known.
std::string placeWords(const FindingFacts& facts);
/// "about 32 cm (26 to 39 cm)"; empty where no marker shows the finding.
std::string endoscopeWords(const FindingFacts& facts);

/// "made by another program: NIfTI, label 1, SHA-256 0123456789ab..., given by anna on 2026-11-25T12:00:00Z".
std::string otherProgramsLumen(const LumenOrigin& origin);

/// All that is known of a finding but its number, kind and leading size.
std::vector<Statement> findingStatements(const ReadCase& read, const FindingWithFacts& finding);

/// That there are markers of no finding; empty where there are none.
std::string unassignedMarkersSentence(const std::vector<std::string>& ids);
/// The reader's; else one line for each finding that is not benign, or that there is none.
std::string impressionText(const ReadCase& read);
/// The reader's, else the usual one of the chosen category.
std::string recommendationText(const ReadCase& read);
/// "C2a: intermediate polyp or indeterminate finding" under "Colon", and so for outside; with the proposal and the
/// reason where another one was chosen, or none was.
std::vector<Statement> categoryStatements(const ReadCase& read);
/// Why the study was made and what it was compared with, where that was said.
std::vector<Statement> occasionStatements(const ReadCase& read);
/// Preparation, tagging, distension and adequacy: how far the study can be relied on.
std::vector<Statement> reliabilityStatements(const ReadCase& read);
/// Technique, dose, coverage and reading time, where they were said.
std::vector<Statement> techniqueStatements(const ReadCase& read);
/// Of each scan whose lumen another program made, that it did; all that lies along the colon is measured in it.
std::vector<Statement> lumenStatements(const ReadCase& read);
/// All of the four.
std::vector<Statement> assessmentStatements(const ReadCase& read);
std::vector<Statement> extracolonicStatements(const ReadCase& read);

/// "Signed by anna, 2026-11-21 08:15 UTC, version 1"; "Draft, not signed".
std::string stateWords(const std::optional<ReportVersion>& version);
/// "Amends version 1, which stays: size read again"; empty where it amends none.
std::string amendmentWords(const std::optional<ReportVersion>& version);

}  // namespace vicon::report
