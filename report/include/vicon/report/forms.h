#pragma once

#include <optional>
#include <string>

#include "vicon/cases/report_content.h"
#include "vicon/cases/report_versions.h"

namespace vicon::report {

/// The report as plain text, to be pasted into a hospital's system: lines of at most 80 characters where words allow.
std::string asText(const ReadCase& read, const std::optional<ReportVersion>& version);

/// The findings as comma-separated values by RFC 4180, UTF-8: a heading, then a line for each marker of each finding;
/// one line for a finding without any.
std::string asCsv(const ReadCase& read);

}  // namespace vicon::report
