#pragma once

#include <soci/soci.h>

#include <string>
#include <vector>

#include "vicon/cases/report_versions.h"

namespace vicon {

// How versions of reports and amendments lie in the database; for callers within a transaction.

std::vector<ReportVersion> versionsIn(soci::session& sql, const std::string& case_id);
ReportStatus statusIn(soci::session& sql, const std::string& case_id);
/// Throws Error{wrong_use} while the report is signed and no amendment was begun.
void requireOpenReport(soci::session& sql, const std::string& case_id);

}  // namespace vicon
