#include "vicon/core/scan_quality.h"

#include <array>
#include <cstdio>

#include "vicon/core/error.h"
#include "vicon/core/json_text.h"

using nlohmann::json;

namespace vicon {
namespace {

constexpr std::array kReasons = {QualityReason::collapsed, QualityReason::implausible_length, QualityReason::noise,
                                 QualityReason::mottled, QualityReason::faint_walls};

std::string text(const char* pattern, double value)
{
    std::array<char, 96> out{};
    std::snprintf(out.data(), out.size(), pattern, value);
    return out.data();
}

json toJson(const StretchQuality& q)
{
    json out = {{"adequate", q.adequate},
                {"median_radius_mm", q.median_radius_mm},
                {"collapsed_mm", q.collapsed_mm},
                {"longest_collapsed_mm", q.longest_collapsed_mm},
                {"collapsed_fraction", q.collapsed_fraction},
                {"volume_ml", q.volume_ml},
                {"fluid_ml", q.fluid_ml},
                {"fluid_fraction", q.fluidFraction()},
                {"mottled_ml", q.mottled_ml},
                {"faint_walls", q.faint_walls}};
    if (q.part)
        out["name"] = nameOf(*q.part);
    return out;
}

StretchQuality stretchFrom(const json& json)
{
    StretchQuality q;
    q.adequate = json.at("adequate").get<bool>();
    q.median_radius_mm = json.at("median_radius_mm").get<double>();
    q.collapsed_mm = json.at("collapsed_mm").get<double>();
    q.longest_collapsed_mm = json.at("longest_collapsed_mm").get<double>();
    q.collapsed_fraction = json.at("collapsed_fraction").get<double>();
    q.volume_ml = json.at("volume_ml").get<double>();
    q.fluid_ml = json.at("fluid_ml").get<double>();
    q.mottled_ml = json.value("mottled_ml", 0.0);
    q.faint_walls = wholeNumber(json, "faint_walls", 0);
    if (const auto name = json.find("name"); name != json.end())
        q.part = colonPartFrom(name->get<std::string>());
    return q;
}

json toJson(const QualityNote& note)
{
    json out = {{"reason", nameOf(note.reason)}, {"value", note.value}};
    if (note.part)
        out["part"] = nameOf(*note.part);
    return out;
}

json toJson(const LumenAlong& along)
{
    json out = {{"step_mm", along.step_mm}, {"radius_mm", along.radius_mm}, {"fluid_fraction", along.fluid_fraction}};
    json& collapsed = out["collapsed"] = json::array();
    for (const StationRange& range : along.collapsed)
        collapsed.push_back({{"from_mm", range.from_mm}, {"to_mm", range.to_mm}});
    return out;
}

LumenAlong alongFrom(const json& json)
{
    LumenAlong along{json.at("step_mm").get<double>(),
                     json.at("radius_mm").get<std::vector<double>>(),
                     json.at("fluid_fraction").get<std::vector<double>>(),
                     {}};
    if (along.step_mm <= 0 || along.radius_mm.size() != along.fluid_fraction.size())
        throw Error(ErrorCode::bad_input, "the lumen along the centreline does not fit together");
    for (const auto& range : json.at("collapsed"))
        along.collapsed.push_back({range.at("from_mm").get<double>(), range.at("to_mm").get<double>()});
    return along;
}

QualityNote noteFrom(const json& json)
{
    QualityNote note{qualityReasonFrom(json.at("reason").get<std::string>()), {}, json.at("value").get<double>()};
    if (const auto part = json.find("part"); part != json.end())
        note.part = colonPartFrom(part->get<std::string>());
    return note;
}

}  // namespace

std::string nameOf(QualityReason reason)
{
    switch (reason) {
        case QualityReason::collapsed:
            return "collapsed";
        case QualityReason::implausible_length:
            return "implausible_length";
        case QualityReason::noise:
            return "noise";
        case QualityReason::mottled:
            return "mottled";
        case QualityReason::faint_walls:
            return "faint_walls";
    }
    return "noise";
}

QualityReason qualityReasonFrom(const std::string& name)
{
    for (const QualityReason reason : kReasons)
        if (nameOf(reason) == name)
            return reason;
    throw Error(ErrorCode::bad_input, "no such reason of a scan's quality", "'" + name + "'");
}

std::string textOf(const QualityNote& note)
{
    switch (note.reason) {
        case QualityReason::collapsed:
            return (note.part ? nameOf(*note.part) + " " : "") + text("collapsed over %.0f mm", note.value);
        case QualityReason::implausible_length:
            return text("a length of %.0f mm is not plausible for a whole colon", note.value);
        case QualityReason::noise:
            return text("more noise than usual: %.0f HU", note.value);
        case QualityReason::mottled:
            return text("%.1f ml of stool or mottled tagging", note.value) +
                   (note.part ? ", " + nameOf(*note.part) : "");
        case QualityReason::faint_walls:
            return text(note.value == 1 ? "%.0f wall hardly shown" : "%.0f walls hardly shown", note.value) +
                   (note.part ? ", " + nameOf(*note.part) : "");
    }
    return {};
}

json toJson(const ScanQuality& quality)
{
    json out = toJson(quality.whole);
    out["noise_hu"] = quality.noise_hu;
    out["reason"] = quality.reason;
    out["thresholds"] = quality.thresholds;
    if (!quality.along.radius_mm.empty())
        out["along"] = toJson(quality.along);
    json& notes = out["notes"] = json::array();
    for (const QualityNote& note : quality.notes)
        notes.push_back(toJson(note));
    json& parts = out["parts"] = json::array();
    for (const StretchQuality& part : quality.parts)
        parts.push_back(toJson(part));
    return out;
}

ScanQuality scanQualityFromJson(const json& json)
{
    ScanQuality quality;
    quality.whole = stretchFrom(json);
    quality.noise_hu = json.at("noise_hu").get<double>();
    quality.reason = json.at("reason").get<std::string>();
    quality.thresholds = json.value("thresholds", nlohmann::json::object());
    if (const auto along = json.find("along"); along != json.end())
        quality.along = alongFrom(*along);
    for (const auto& note : json.value("notes", nlohmann::json::array()))
        quality.notes.push_back(noteFrom(note));
    for (const auto& part : json.at("parts"))
        quality.parts.push_back(stretchFrom(part));
    return quality;
}

}  // namespace vicon
