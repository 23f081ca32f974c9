#pragma once

#include <vector>

#include "vicon/cases/report_content.h"
#include "vicon/report/statements.h"

namespace vicon::report {

/// "polyp of 6.1 mm in the sigmoid on 2023-05-04 (Finding 1, VICON)".
std::string priorWords(const Comparison& comparison);

/// Of every comparison that the reader confirmed: under "Finding 2" what it was then, what it is now, and its growth or
/// why that is not told.
std::vector<Statement> comparisonStatements(const ReadCase& read);

}  // namespace vicon::report
