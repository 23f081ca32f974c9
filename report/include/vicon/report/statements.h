#pragma once

#include <string>
#include <vector>

#include "vicon/report/content.h"

namespace vicon::report {

/// One line of a report: what it is about, and what is said. UTF-8; the text may hold line breaks.
struct Statement {
    std::string label;
    std::string text;
    friend bool operator==(const Statement&, const Statement&) = default;
};

/// Printed on every page of a report that nobody has signed.
inline constexpr const char* kDraftLine = "DRAFT - unsigned - made by research software that is no medical device";

inline constexpr const char* kPreliminaryLine =
    "PRELIMINARY - unsigned - made by research software that is no medical device";

/// Name, ID, birth date and sex; what the case does not say is said to be not given.
std::vector<Statement> patientStatements(const CaseRecord& a_case);
/// Date, description, accession number, referring physician and institution; only those that are given, date always.
std::vector<Statement> studyStatements(const CaseRecord& a_case);

/// "Prone, head first · series 3".
std::string scanTitle(const ScanEntry& entry);
/// Series, geometry, compression, result of the segmentation, colon length, bridges, quality, and what ingest repaired
/// or refused.
std::vector<Statement> scanStatements(const ScanEntry& entry);

/// Whether there is nothing about a scan that a reader must know: a colon that was surely found, without bridges,
/// repairs and refusals, adequate and not lossy.
bool isPlain(const ScanEntry& entry);
/// Its series, geometry and colon length in a line.
Statement briefStatement(const ScanEntry& entry);

/// Position, part, distances from both ends, fraction, size and paired marker where given and, last, the estimated
/// endoscope distance.
std::vector<Statement> markerStatements(const MarkerEntry& entry);

/// Whether the marker's scan went through a lossy compression.
bool isLossy(const ReportContent& content, const std::string& scan_id);

}  // namespace vicon::report
