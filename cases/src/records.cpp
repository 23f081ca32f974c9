#include "vicon/cases/records.h"

#include "vicon/core/error.h"

namespace vicon {

// As NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT, but here: in the header every file would compile it again.
#define VICON_JSON_FORM(Type, ...)                                                              \
    void to_json(nlohmann::json& nlohmann_json_j, const Type& nlohmann_json_t)                  \
    {                                                                                           \
        NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_TO, __VA_ARGS__))                \
    }                                                                                           \
    void from_json(const nlohmann::json& nlohmann_json_j, Type& nlohmann_json_t)                \
    {                                                                                           \
        const Type nlohmann_json_default_obj;                                                   \
        NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_FROM_WITH_DEFAULT, __VA_ARGS__)) \
    }

VICON_JSON_FORM(Patient, id, name, birth_date, sex)
VICON_JSON_FORM(Study, uid, id, date, time, description, accession_number, referring_physician, institution)
VICON_JSON_FORM(Series, uid, number, description, modality, patient_position, frame_of_reference_uid, manufacturer,
                kernel, kvp, slice_thickness_mm, lossy)
#undef VICON_JSON_FORM

std::string positionName(const std::string& position)
{
    if (position.ends_with("DL"))
        return "left decubitus";
    if (position.ends_with("DR"))
        return "right decubitus";
    if (position == "HFS" || position == "FFS")
        return "supine";
    if (position == "HFP" || position == "FFP")
        return "prone";
    return "unknown";
}

Vector3 gravityFor(const std::string& position)
{
    const std::string name = positionName(position);
    if (name == "prone")
        return {0, -1, 0};
    if (name == "left decubitus")  // lying on the left side
        return {1, 0, 0};
    if (name == "right decubitus")
        return {-1, 0, 0};
    return {0, 1, 0};
}

std::string nameOf(ScanRole role)
{
    switch (role) {
        case ScanRole::scan:
            return "scan";
        case ScanRole::kept:
            return "kept";
        case ScanRole::refused:
            return "refused";
    }
    return "refused";
}

ScanRole scanRoleFrom(const std::string& name)
{
    for (const ScanRole role : {ScanRole::scan, ScanRole::kept, ScanRole::refused})
        if (nameOf(role) == name)
            return role;
    throw Error(ErrorCode::bad_input, "a scan has no such role", "'" + name + "'");
}

}  // namespace vicon
