#include "vicon/cases/marker.h"

#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/geometry_json.h"
#include "vicon/core/json_text.h"

using nlohmann::json;

namespace vicon {
namespace {

constexpr const char* kAlwaysThere[] = {"id",         "scan",           "position_mm", "color",   "note",
                                        "station_mm", "from_caecum_mm", "fraction",    "created", "changed"};

/// Takes a key out of `extra`, understood; leaves it there where another program wrote something else under its name.
template <class Read>
auto takeKnown(json& extra, const char* key, Read read) -> std::optional<decltype(read(extra))>
{
    const auto found = extra.find(key);
    if (found == extra.end())
        return std::nullopt;
    try {
        std::optional<decltype(read(extra))> out = read(*found);
        extra.erase(found);
        return out;
    } catch (const json::exception&) {
        return std::nullopt;
    } catch (const Error&) {  // a text that is no name of a part
        return std::nullopt;
    }
}

/// One as a text, several as a list.
std::vector<std::string> partnersFrom(const json& value)
{
    auto ids = value.is_string() ? std::vector{value.get<std::string>()} : value.get<std::vector<std::string>>();
    std::erase(ids, std::string());
    return ids;
}

template <class Known>
void put(json& out, const char* key, const std::optional<Known>& known)
{
    if (known)
        out[key] = toJson(*known);
}

}  // namespace

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

std::string partnerNames(const Marker& marker)
{
    std::string names;
    for (const std::string& id : marker.partners)
        names += (names.empty() ? "" : ", ") + id;
    return names;
}

json toJson(const Marker& m)
{
    json out = m.extra.is_object() ? m.extra : json::object();
    out["id"] = m.id;
    out["scan"] = m.scan_id;
    out["position_mm"] = m.position_mm;
    out["color"] = nameOf(m.color);
    out["note"] = m.note;
    out["station_mm"] = m.station_mm;
    out["from_caecum_mm"] = m.from_caecum_mm;
    out["fraction"] = m.fraction;
    out["created"] = m.created;
    out["changed"] = m.changed;
    if (m.part)
        out["part"] = nameOf(*m.part);
    if (m.partners.size() == 1)
        out["pair"] = m.partners.front();
    else if (!m.partners.empty())
        out["pair"] = m.partners;
    put(out, "size", m.size);
    put(out, "density", m.density);
    put(out, "view", m.view);
    return out;
}

Marker markerFromJson(const json& json)
{
    try {
        Marker m;
        m.id = json.value("id", "");
        m.scan_id = json.value("scan", "");
        m.position_mm = json.at("position_mm").get<Point3>();
        m.color = markerColorFrom(json.at("color").get<std::string>());
        m.note = json.value("note", "");
        m.station_mm = json.value("station_mm", 0.0);
        m.from_caecum_mm = json.value("from_caecum_mm", 0.0);
        m.fraction = json.value("fraction", 0.0);
        m.created = json.value("created", "");
        m.changed = json.value("changed", "");
        m.extra = json;
        for (const char* key : kAlwaysThere)
            m.extra.erase(key);
        const auto text = [](const nlohmann::json& value) { return value.get<std::string>(); };
        m.part = takeKnown(m.extra, "part", [&](const nlohmann::json& value) { return colonPartFrom(text(value)); });
        m.partners = takeKnown(m.extra, "pair", partnersFrom).value_or(std::vector<std::string>());
        m.size = takeKnown(m.extra, "size", markerSizeFromJson);
        m.density = takeKnown(m.extra, "density", densitySampleFromJson);
        m.view = takeKnown(m.extra, "view", markerViewFromJson);
        return m;
    } catch (const nlohmann::json::exception& e) {
        throw Error(ErrorCode::bad_input, std::string("not a marker: ") + e.what(), "marker");
    }
}

json toJson(const std::vector<Marker>& markers)
{
    json list = json::array();
    for (const Marker& marker : markers)
        list.push_back(toJson(marker));
    return {{"markers", list}};
}

void writeMarkers(const std::filesystem::path& file, const std::vector<Marker>& markers)
{
    replaceFile(file, toJson(markers).dump(2) + "\n");
}

std::vector<Marker> readMarkers(const std::filesystem::path& file)
{
    const json all = parsedJson(readFile(file));
    if (!all.is_object() || !all.contains("markers") || !all["markers"].is_array())
        throw Error(ErrorCode::bad_input, "is not a file of markers", file.string(), "it must be {\"markers\": [...]}");
    std::vector<Marker> markers;
    for (const json& entry : all["markers"])
        markers.push_back(markerFromJson(entry));
    return markers;
}

}  // namespace vicon
