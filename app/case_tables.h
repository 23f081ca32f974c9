#pragma once

#include <string>
#include <vector>

#include "vicon/cases/report_content.h"
#include "vicon/cases/report_versions.h"

namespace vicon::app {

// What the subcommands about findings and reports share.

/// "m1,m2" as names, without blanks around them; "none" is an empty list.
std::vector<std::string> namesFrom(const std::string& text);
/// Throws Error{wrong_use} for what is no number in the range.
double numberFrom(const std::string& text, const char* option, double least, double most);

/// Findings, the proposed and the chosen categories, and the report's state.
void printFindings(bool json, CaseStore& store, const ReadCase& read);

}  // namespace vicon::app
