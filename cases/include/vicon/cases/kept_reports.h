#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/cases/content_tree.h"

namespace vicon {

/// A structured report that came from elsewhere and is kept as it came, for the patient's later studies.
struct KeptReport {
    std::string sop_uid, sop_class, series_uid;
    Patient patient;
    Study study;
    std::string sha256;
    std::string file;  ///< name in the folder of kept reports
    std::string created;
};

/// Where the files of kept reports lie.
std::filesystem::path keptReportsFolder(const CaseStore& store);

std::optional<KeptReport> findKeptReport(CaseStore& store, const std::string& sop_uid);
/// Of this patient ID, in order of study date.
std::vector<KeptReport> keptReportsOf(CaseStore& store, const std::string& patient_id);
/// Its file must lie in the folder already. One that is kept under the same UID is replaced. Throws Error{database}.
void keepReport(CaseStore& store, const KeptReport& report);

}  // namespace vicon
