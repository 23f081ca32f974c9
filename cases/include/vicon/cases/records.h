#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "vicon/core/scan_records.h"
#include "vicon/core/study.h"

namespace vicon {

/// A row of the worklist.
struct CaseRecord {
    std::string id;
    Patient patient;
    Study study;
    std::vector<std::string> flags;  ///< what a person must decide, one line each
    std::string created;
};

/// In what ingest wrote: the application entity title by which its images were sent.
inline constexpr const char* kIngestSender = "sender";

/// A scan and what ingest found out about it.
struct ScanRecord {
    std::string id;
    std::string case_id;
    Series series;
    ScanRole role = ScanRole::scan;
    /// What ingest wrote: {"geometry": .., "repairs": [..], "refused": [..]}; goes into scan.json as it is.
    nlohmann::json ingest = nlohmann::json::object();
    std::string created;
};

/// A stored object.
struct InstanceRecord {
    std::string sop_uid;
    std::string case_id;
    std::string scan_id;
    std::string sha256;
    std::string file;  ///< name in the scan's dicom/ folder
};

}  // namespace vicon
