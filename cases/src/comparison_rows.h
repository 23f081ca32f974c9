#pragma once

#include <soci/soci.h>

#include <string>
#include <vector>

#include "vicon/cases/comparisons.h"

namespace vicon {

// How comparisons lie in the database; for callers within a transaction.

std::vector<Comparison> comparisonsIn(soci::session& sql, const std::string& case_id);
void putComparison(soci::session& sql, const std::string& case_id, const Comparison& one);

}  // namespace vicon
