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

std::string nameOf(MarkerColor color)
{
    switch (color) {
        case MarkerColor::red:
            return "red";
        case MarkerColor::yellow:
            return "yellow";
        case MarkerColor::green:
            return "green";
    }
    return "red";
}

MarkerColor markerColorFrom(const std::string& name)
{
    for (const MarkerColor color : {MarkerColor::red, MarkerColor::yellow, MarkerColor::green})
        if (nameOf(color) == name)
            return color;
    throw Error(ErrorCode::wrong_use, "a marker's color must be red, yellow or green", "'" + name + "'");
}

nlohmann::json toJson(const Marker& m)
{
    nlohmann::json out = m.extra.is_object() ? m.extra : nlohmann::json::object();
    out["id"] = m.id;
    out["scan"] = m.scan_id;
    out["position_mm"] = {m.position_mm.x, m.position_mm.y, m.position_mm.z};
    out["color"] = nameOf(m.color);
    out["note"] = m.note;
    out["station_mm"] = m.station_mm;
    out["from_caecum_mm"] = m.from_caecum_mm;
    out["fraction"] = m.fraction;
    out["created"] = m.created;
    out["changed"] = m.changed;
    return out;
}

Marker markerFromJson(const nlohmann::json& json)
{
    static const char* const kKnown[] = {"id",         "scan",           "position_mm", "color",   "note",
                                         "station_mm", "from_caecum_mm", "fraction",    "created", "changed"};
    try {
        Marker m;
        m.id = json.value("id", "");
        m.scan_id = json.value("scan", "");
        const auto& p = json.at("position_mm");
        if (!p.is_array() || p.size() != 3)
            throw Error(ErrorCode::bad_input, "position_mm must be three numbers", "marker");
        m.position_mm = {p[0].get<double>(), p[1].get<double>(), p[2].get<double>()};
        m.color = markerColorFrom(json.at("color").get<std::string>());
        m.note = json.value("note", "");
        m.station_mm = json.value("station_mm", 0.0);
        m.from_caecum_mm = json.value("from_caecum_mm", 0.0);
        m.fraction = json.value("fraction", 0.0);
        m.created = json.value("created", "");
        m.changed = json.value("changed", "");
        m.extra = json;
        for (const char* key : kKnown)
            m.extra.erase(key);
        return m;
    } catch (const nlohmann::json::exception& e) {
        throw Error(ErrorCode::bad_input, std::string("not a marker: ") + e.what(), "marker");
    }
}

}  // namespace vicon
