#pragma once

#include <string>
#include <vector>

#include "scan_assembly.h"

namespace vicon::ingest {

/// What arrives after readers have worked on a case changes nothing of their work, but they must be told: the words of
/// the flag. Empty where there is nothing to tell, or where a person settled that flag before.
std::string flagForLateScan(const ImportContext& context, const StoredStudy& stored,
                            const std::vector<AssembledScan>& scans, const AssembledScan& late);

/// Tells of a flag that the case was saved with.
void tellFlag(const ImportContext& context, const std::string& case_id, const std::string& line);

/// Flags a case and another with the same patient ID, where name or birth date differ.
void flagSharedId(const ImportContext& context, const CaseRecord& of_case);

}  // namespace vicon::ingest
