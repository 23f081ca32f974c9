#pragma once

#include <nlohmann/json.hpp>
#include <string>

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

/// How the patient lay.
enum class BodyPosition { supine, prone, left_decubitus, right_decubitus, unknown };
/// "supine", "prone", "left decubitus", "right decubitus", "unknown".
std::string nameOf(BodyPosition position);
/// From DICOM's Patient Position, such as "HFS".
BodyPosition bodyPositionFrom(const std::string& patient_position);
/// The name of bodyPositionFrom().
std::string positionName(const std::string& patient_position);

/// The direction in which a fluid falls (unit vector, LPS), from DICOM's Patient Position; posterior when not said.
Vector3 gravityFor(const std::string& patient_position);

}  // namespace vicon
