#pragma once

#include <filesystem>
#include <functional>
#include <map>
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
/// The same of any folder that holds reports of a case.
std::vector<std::filesystem::path> versionObjectsIn(const std::filesystem::path& folder, int version);

/// How many reports of each of these cases were written: drafts, wherever they were written to, and versions that were
/// given out. The last draft's number is the number of drafts. Cases without a report are not among them.
std::map<std::string, int> countReports(CaseStore& store, const std::vector<CaseRecord>& cases);

/// A draft that was written, numbered 1, 2, ... within its case.
struct WrittenDraft {
    int number = 0;
    std::filesystem::path file;
};
/// Writes a draft under the case's next number, which is used up only where it was written.
/// @param out where to; empty: reportFile()
/// @param draw the PDF under this number; once more where another report was written meanwhile
/// Throws Error{store} and Error{database} when it cannot be written.
WrittenDraft writeDraft(CaseStore& store, const std::string& case_id, const std::filesystem::path& out,
                        const std::function<std::string(int number)>& draw);
/// The number that writeDraft() would give now.
int nextDraftNumber(CaseStore& store, const std::string& case_id);

/// Throws Error{unusable_scan} for a case whose scans all show other organs: a report tells of a colon.
void requireReportable(CaseStore& store, const CaseRecord& record);

}  // namespace vicon
