#pragma once

#include <string>
#include <vector>

#include "scan_assembly.h"

namespace vicon::ingest {

/// What comes after people have spoken of a case changes nothing of that, and they must hear of it: the flag's words.
/// Empty when nobody need, or when a person took that flag away before.
std::string flagForLateScan(const ImportContext& context, const StoredStudy& stored,
                            const std::vector<AssembledScan>& scans, const AssembledScan& late);

/// Tells of a flag that the case was saved with.
void tellFlag(const ImportContext& context, const std::string& case_id, const std::string& line);

/// Flags a case and another with the same patient ID, where name or birth date differ.
void flagSharedId(const ImportContext& context, const CaseRecord& of_case);

}  // namespace vicon::ingest
