#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "vicon/core/geometry.h"

namespace vicon {

/// Who the case is about. Texts are UTF-8, in the form DICOM gives them ("Family^Given", "YYYYMMDD").
struct Patient {
    std::string id;
    std::string name;
    std::string birth_date;
    std::string sex;
};
void to_json(nlohmann::json& json, const Patient& from);
void from_json(const nlohmann::json& json, Patient& to);

struct Study {
    std::string uid;
    std::string id;
    std::string date;  ///< YYYYMMDD
    std::string time;
    std::string description;
    std::string accession_number;
    std::string referring_physician;
    std::string institution;
};
void to_json(nlohmann::json& json, const Study& from);
void from_json(const nlohmann::json& json, Study& to);

struct Series {
    std::string uid;
    int number = 0;
    std::string description;
    std::string modality;
    std::string patient_position;  ///< DICOM's code: HFS, HFP, FFS, FFP, HFDL, HFDR, FFDL, FFDR; empty: not said
    std::string frame_of_reference_uid;
    std::string manufacturer;
    std::string kernel;
    double kvp = 0;
    double slice_thickness_mm = 0;
    bool lossy = false;  ///< pixels went through a lossy compression somewhere
};
void to_json(nlohmann::json& json, const Series& from);
void from_json(const nlohmann::json& json, Series& to);

/// "supine", "prone", "left decubitus", "right decubitus", or "unknown", from DICOM's Patient Position.
std::string positionName(const std::string& patient_position);

/// The direction in which a fluid falls (unit vector, LPS), from DICOM's Patient Position; posterior when not said.
Vector3 gravityFor(const std::string& patient_position);

/// A row of the worklist.
struct CaseRecord {
    std::string id;
    Patient patient;
    Study study;
    std::vector<std::string> flags;  ///< what a person must decide, one line each
    std::string created;
};

/// What becomes of a scan.
enum class ScanRole {
    scan,     ///< goes through the pipeline
    kept,     ///< stored and selectable, not queued: another reconstruction, too few slices
    refused,  ///< its objects are stored, but make no volume: `ingest` says why, more objects may mend it
};
/// "scan", "kept", "refused".
std::string nameOf(ScanRole role);
/// Throws Error{bad_input} for any other name.
ScanRole scanRoleFrom(const std::string& name);

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

/// A finished step of the pipeline.
struct StepRecord {
    std::string step;
    int version = 0;            ///< of the step's code
    std::string digest;         ///< of parameters, version and everything it was computed from
    nlohmann::json parameters;  ///< as they were used
    nlohmann::json result;      ///< measures, for scan.json
    double seconds = 0;
    std::string finished;
};

}  // namespace vicon
