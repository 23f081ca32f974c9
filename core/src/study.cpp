#include "vicon/core/study.h"

#include "vicon/core/json_text.h"

namespace vicon {

// As NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT, but here: in the header every file would compile it again.
#define VICON_JSON_TO(Type, ...)                                                 \
    void to_json(nlohmann::json& nlohmann_json_j, const Type& nlohmann_json_t)   \
    {                                                                            \
        NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_TO, __VA_ARGS__)) \
    }
#define VICON_JSON_FROM(Type, ...)                                                              \
    void from_json(const nlohmann::json& nlohmann_json_j, Type& nlohmann_json_t)                \
    {                                                                                           \
        const Type nlohmann_json_default_obj;                                                   \
        NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_FROM_WITH_DEFAULT, __VA_ARGS__)) \
    }

VICON_JSON_TO(Patient, id, name, birth_date, sex)
VICON_JSON_FROM(Patient, id, name, birth_date, sex)
VICON_JSON_TO(Study, uid, id, date, time, description, accession_number, referring_physician, institution)
VICON_JSON_FROM(Study, uid, id, date, time, description, accession_number, referring_physician, institution)
VICON_JSON_TO(Series, uid, number, description, modality, patient_position, frame_of_reference_uid, manufacturer,
              kernel, kvp, slice_thickness_mm, lossy)
#undef VICON_JSON_TO
#undef VICON_JSON_FROM

void from_json(const nlohmann::json& nlohmann_json_j, Series& nlohmann_json_t)
{
    const Series nlohmann_json_default_obj;
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_FROM_WITH_DEFAULT, uid, description, modality,
                                             patient_position, frame_of_reference_uid, manufacturer, kernel, kvp,
                                             slice_thickness_mm, lossy))
    nlohmann_json_t.number = wholeNumber(nlohmann_json_j, "number", nlohmann_json_default_obj.number);
}

std::string nameOf(BodyPosition position)
{
    switch (position) {
        case BodyPosition::supine:
            return "supine";
        case BodyPosition::prone:
            return "prone";
        case BodyPosition::left_decubitus:
            return "left decubitus";
        case BodyPosition::right_decubitus:
            return "right decubitus";
        case BodyPosition::unknown:
            break;
    }
    return "unknown";
}

BodyPosition bodyPositionFrom(const std::string& patient_position)
{
    if (patient_position.ends_with("DL"))
        return BodyPosition::left_decubitus;
    if (patient_position.ends_with("DR"))
        return BodyPosition::right_decubitus;
    if (patient_position == "HFS" || patient_position == "FFS")
        return BodyPosition::supine;
    if (patient_position == "HFP" || patient_position == "FFP")
        return BodyPosition::prone;
    return BodyPosition::unknown;
}

std::string positionName(const std::string& patient_position)
{
    return nameOf(bodyPositionFrom(patient_position));
}

Vector3 gravityFor(const std::string& patient_position)
{
    switch (bodyPositionFrom(patient_position)) {
        case BodyPosition::prone:
            return {0, -1, 0};
        case BodyPosition::left_decubitus:  // lying on the left side
            return {1, 0, 0};
        case BodyPosition::right_decubitus:
            return {-1, 0, 0};
        case BodyPosition::supine:
        case BodyPosition::unknown:
            break;
    }
    return {0, 1, 0};
}

}  // namespace vicon
