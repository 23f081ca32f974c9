#include "json_fields.h"
#include "vicon/cases/finding_facts.h"
#include "vicon/core/enum_names.h"
#include "vicon/core/geometry_json.h"
#include "vicon/core/json_text.h"

using nlohmann::json;

namespace vicon {
namespace {

constexpr EnumNames<SizeSource, 4> kSizeSourceNames = {{{SizeSource::reader, "reader"},
                                                        {SizeSource::plane, "best plane"},
                                                        {SizeSource::slice, "slice"},
                                                        {SizeSource::surface, "surface"}}};

constexpr std::pair<const char*, std::optional<double> FindingSight::*> kOfPartAndOutline[] = {
    {"part_fraction", &FindingSight::part_fraction},   {"size_least_mm", &FindingSight::size_least_mm},
    {"size_most_mm", &FindingSight::size_most_mm},     {"height_mm", &FindingSight::height_mm},
    {"volume_ml", &FindingSight::volume_ml},           {"volume_least_ml", &FindingSight::volume_least_ml},
    {"volume_most_ml", &FindingSight::volume_most_ml},
};

SizeSource sizeSourceFrom(const std::string& name)
{
    return valueIn(kSizeSourceNames, name, "a size's source");
}

json sightJson(const FindingSight& s)
{
    json out = {{"marker", s.marker_id},
                {"scan", s.scan_id},
                {"position_mm", s.position_mm},
                {"station_mm", s.station_mm},
                {"from_caecum_mm", s.from_caecum_mm},
                {"fraction", s.fraction}};
    putName(out, "part", s.part);
    putValue(out, "clock_hour", s.clock_hour);
    putValue(out, "size_2d_mm", s.size_2d_mm);
    putValue(out, "size_3d_mm", s.size_3d_mm);
    if (s.size_in_slice)
        out["size_in_slice"] = true;
    putValue(out, "mean_hu", s.mean_hu);
    for (const auto& [key, figure] : kOfPartAndOutline)
        putValue(out, key, s.*figure);
    return out;
}

FindingSight sightFromJson(const json& from)
{
    FindingSight s;
    s.marker_id = from.at("marker").get<std::string>();
    s.scan_id = from.at("scan").get<std::string>();
    s.position_mm = from.at("position_mm").get<Point3>();
    s.station_mm = from.at("station_mm").get<double>();
    s.from_caecum_mm = from.at("from_caecum_mm").get<double>();
    s.fraction = from.at("fraction").get<double>();
    s.part = named(from, "part", colonPartFrom);
    if (from.contains("clock_hour"))
        s.clock_hour = wholeNumber(from["clock_hour"]);
    s.size_2d_mm = number(from, "size_2d_mm");
    s.size_3d_mm = number(from, "size_3d_mm");
    s.size_in_slice = from.value("size_in_slice", false);
    s.mean_hu = number(from, "mean_hu");
    for (const auto& [key, figure] : kOfPartAndOutline)
        s.*figure = number(from, key);
    return s;
}

}  // namespace

std::string nameOf(SizeSource source)
{
    return nameIn(kSizeSourceNames, source);
}

json toJson(const FindingFacts& facts)
{
    json out = {{"sights", json::array()}};
    for (const FindingSight& sight : facts.sights)
        out["sights"].push_back(sightJson(sight));
    if (facts.leading)
        out["leading"] = facts.lead()->marker_id;
    if (facts.size_mm) {
        out["size_mm"] = *facts.size_mm;
        out["size_source"] = nameOf(facts.size_source);
    }
    putValue(out, "size_2d_mm", facts.size_2d_mm);
    putValue(out, "size_3d_mm", facts.size_3d_mm);
    if (facts.size_in_slice)
        out["size_in_slice"] = true;
    putValue(out, "mean_hu", facts.mean_hu);
    if (facts.endoscope)
        out["endoscope_mm"] = {{"about", facts.endoscope->about_mm},
                               {"least", facts.endoscope->least_mm},
                               {"most", facts.endoscope->most_mm}};
    return out;
}

FindingFacts factsFromJson(const json& from)
{
    return understood("the facts of a finding", [&] {
        FindingFacts facts;
        for (const json& sight : from.at("sights")) {
            facts.sights.push_back(sightFromJson(sight));
            if (facts.sights.back().marker_id == from.value("leading", ""))
                facts.leading = facts.sights.size() - 1;
        }
        facts.size_mm = number(from, "size_mm");
        facts.size_source = named(from, "size_source", sizeSourceFrom).value_or(SizeSource::reader);
        facts.size_2d_mm = number(from, "size_2d_mm");
        facts.size_3d_mm = number(from, "size_3d_mm");
        facts.size_in_slice = from.value("size_in_slice", false);
        facts.mean_hu = number(from, "mean_hu");
        if (from.contains("endoscope_mm"))
            facts.endoscope = EndoscopeDistance{from["endoscope_mm"].at("about").get<double>(),
                                                from["endoscope_mm"].at("least").get<double>(),
                                                from["endoscope_mm"].at("most").get<double>()};
        return facts;
    });
}

}  // namespace vicon
