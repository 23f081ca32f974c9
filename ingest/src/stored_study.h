#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "image_object.h"
#include "import_reporter.h"

namespace vicon::ingest {

/// In the key of a scan's id: its images came after a scan of their series was fixed.
inline constexpr const char* kLater = "|later";

/// What the store has of a study when an import begins.
struct StoredStudy {
    struct Home {
        std::string scan_id;
        std::string file;
    };
    CaseRecord record;                        ///< new, where the store has nothing of the study
    std::map<std::string, ScanRecord> scans;  ///< by id
    std::set<std::string> with_reader_input;  ///< ids of scans; see hasReaderInput()
    std::set<std::string> held;               ///< ids of scans; see hold()
    /// Of held scans the recorded objects that are not usable, by id of scan.
    std::map<std::string, std::vector<std::string>> missing;
    std::map<std::string, ImageObject> objects;      ///< those that can be used, by SOP Instance UID
    std::map<std::string, Home> home;                ///< where those lie
    std::map<std::string, InstanceRecord> recorded;  ///< by SOP Instance UID, lost and damaged ones too
    std::map<std::string, std::string> unusable;     ///< why those cannot be used, by SOP Instance UID

    /// Whether its objects, its role and its words stay as they are: a reader has worked on it, or it is held.
    bool isFixed(const std::string& scan_id) const
    {
        return with_reader_input.contains(scan_id) || held.contains(scan_id);
    }
    /// Holds the scans of a series as they are while one of its recorded objects is not among the usable ones: what
    /// cannot be used now may be whole, and is not to be taken for gone. What came since makes a scan that may grow.
    void hold(const std::map<std::string, ImageObject>& usable);
};

/// Where a scan's images lie.
std::filesystem::path imageFolder(const CaseStore& store, const std::string& case_id, const std::string& scan_id);

/// Reads and inspects what the store has of a study.
StoredStudy loadStoredStudy(const ImportContext& context, const Patient& patient, const Study& study);

}  // namespace vicon::ingest
