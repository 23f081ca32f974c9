#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"

namespace vicon {

/// The file of a case's report in the store; its folder is made. Throws Error{store}.
std::filesystem::path reportFile(CaseStore& store, const std::string& case_id, int number);

/// Where a case's reports lie.
std::filesystem::path reportFolder(const CaseStore& store, const std::string& case_id);
/// The name there of the file of a version that was given out.
std::string versionName(int version);

/// The DICOM objects of a version that was signed, by name: version-N-KIND.dcm.
std::vector<std::filesystem::path> versionObjects(const CaseStore& store, const std::string& case_id, int version);

/// How many reports of a case lie in the store.
int countReports(const CaseStore& store, const std::string& case_id);

/// Throws Error{unusable_scan} for a case whose scans all show other organs: a report tells of a colon.
void requireReportable(CaseStore& store, const CaseRecord& record);

}  // namespace vicon
