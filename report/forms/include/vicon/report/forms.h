#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "vicon/cases/report_content.h"
#include "vicon/cases/report_versions.h"

namespace vicon::report {

// The forms that a report takes outside the PACS. @param version absent: the draft

/// The report as plain text, to be pasted into a hospital's system: lines of at most 80 characters where words allow.
std::string asText(const ReadCase& read, const std::optional<ReportVersion>& version);

/// The findings as comma-separated values by RFC 4180, UTF-8: a heading, then a line for each marker of each finding;
/// one line for a finding without any.
std::string asCsv(const ReadCase& read);

/// A FHIR R4 Bundle (type "collection"): Patient, ImagingStudy, an Observation for each finding, for each marker that
/// shows it and for what was said of the whole study, and the DiagnosticReport that refers to them all. Resources keep
/// their URLs from version to version. The report's text is its narrative.
nlohmann::json asFhir(const ReadCase& read, const std::optional<ReportVersion>& version);

/// An HL7 v2.5.1 message ORU^R01, UTF-8, its segments ended by carriage returns: the report's text, impression and
/// categories, then findings with their numbers; OBX-4 holds a finding's number.
std::string asHl7(const ReadCase& read, const std::optional<ReportVersion>& version);

}  // namespace vicon::report
