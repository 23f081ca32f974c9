#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "image_object.h"
#include "import_reporter.h"

namespace vicon::ingest {

/// What the store has of a study when an import begins.
struct StoredStudy {
    struct Home {
        std::string scan_id;
        std::string file;
    };
    CaseRecord record;                           ///< new, where the store has nothing of the study
    std::map<std::string, ScanRecord> scans;     ///< by id
    std::set<std::string> with_reader_input;     ///< ids of scans; see hasReaderInput()
    std::map<std::string, ImageObject> objects;  ///< those that can be read, by SOP Instance UID
    std::map<std::string, Home> home;            ///< where those lie
    std::map<std::string, std::string> scan_of;  ///< where an object is recorded, damaged ones too

    /// Whether its objects, its role and its words stay as they are, because a reader has worked on it.
    bool isFixed(const std::string& scan_id) const { return with_reader_input.contains(scan_id); }
};

/// Where a scan's images lie.
std::filesystem::path imageFolder(const CaseStore& store, const std::string& case_id, const std::string& scan_id);

/// Reads and inspects what the store has of a study.
StoredStudy loadStoredStudy(const ImportContext& context, const Patient& patient, const Study& study);

}  // namespace vicon::ingest
