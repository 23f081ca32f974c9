#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "vicon/core/scan_records.h"
#include "vicon/core/study.h"

namespace vicon::scan_files {

/// What scan.json says: what the database holds of the scan, for everyone who reads files.
struct ScanDescription {
    std::string case_id, scan_id;
    Patient patient;
    Study study;
    Series series;
    ScanRole role = ScanRole::scan;
    std::string created;                               ///< UTC
    nlohmann::json ingest = nlohmann::json::object();  ///< what import did; its keys stand beside those above
    std::vector<StepRecord> steps;
};

/// Its one JSON form, docs/dev/schemas/scan.schema.json. Of the steps' results some stand at the top level as well.
nlohmann::json toJson(const ScanDescription& description);
/// What is missing keeps its default. Throws nlohmann::json::exception or Error{bad_input} for other content.
ScanDescription scanDescriptionFromJson(const nlohmann::json& json);

/// Writes scan.json into a scan's folder.
void writeDescription(const std::filesystem::path& scan_folder, const ScanDescription& description);

/// scan.json of a scan's folder; of defaults where there is none. Throws Error{bad_input}.
ScanDescription readDescription(const std::filesystem::path& scan_folder);

/// Whether scan.json is there, can be read and says just this.
bool isDescribedBy(const std::filesystem::path& scan_folder, const ScanDescription& description);

}  // namespace vicon::scan_files
