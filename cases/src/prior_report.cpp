#include "vicon/cases/prior_report.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "json_fields.h"
#include "vicon/cases/printed.h"
#include "vicon/core/geometry_json.h"

using nlohmann::json;

namespace vicon {
namespace {

/// Where there is something.
void putText(json& out, const char* key, const std::string& text)
{
    if (!text.empty())
        out[key] = text;
}

json sightJson(const PriorSight& s)
{
    json out = json::object();
    putText(out, "marker", s.marker);
    putText(out, "series_uid", s.series_uid);
    putText(out, "image_uid", s.image_uid);
    putText(out, "frame_of_reference_uid", s.frame_of_reference_uid);
    putValue(out, "position_mm", s.position_mm);
    putName(out, "part", s.part);
    putText(out, "site", s.site);
    putValue(out, "station_mm", s.station_mm);
    putValue(out, "from_caecum_mm", s.from_caecum_mm);
    putValue(out, "fraction", s.fraction);
    putValue(out, "part_fraction", s.part_fraction);
    putValue(out, "clock_hour", s.clock_hour);
    putValue(out, "size_2d_mm", s.size_2d_mm);
    putValue(out, "size_3d_mm", s.size_3d_mm);
    putValue(out, "size_least_mm", s.size_least_mm);
    putValue(out, "size_most_mm", s.size_most_mm);
    putValue(out, "height_mm", s.height_mm);
    putValue(out, "volume_ml", s.volume_ml);
    putValue(out, "volume_least_ml", s.volume_least_ml);
    putValue(out, "volume_most_ml", s.volume_most_ml);
    putValue(out, "mean_hu", s.mean_hu);
    return out;
}

json measuresJson(const std::vector<PriorMeasure>& measures)
{
    json out = json::array();
    for (const PriorMeasure& m : measures)
        out.push_back({{"name", m.name}, {"value", m.value}, {"unit", m.unit}});
    return out;
}

}  // namespace

const PriorFinding* PriorReport::finding(const std::string& uid) const
{
    const auto found = std::find_if(findings.begin(), findings.end(), [&](const auto& f) { return f.uid == uid; });
    return found == findings.end() ? nullptr : &*found;
}

const PriorScan* PriorReport::scan(const std::string& uid) const
{
    const auto found = std::find_if(scans.begin(), scans.end(), [&](const auto& s) { return s.series_uid == uid; });
    return found == scans.end() ? nullptr : &*found;
}

json toJson(const PriorFinding& f)
{
    json out = {{"uid", f.uid},
                {"name", f.name},
                {"what", f.what},
                {"narrows_lumen", f.narrows_lumen},
                {"invades", f.invades},
                {"note", f.note},
                {"sights", json::array()},
                {"leading", f.leading},
                {"others", measuresJson(f.others)}};
    putName(out, "kind", f.kind);
    putName(out, "morphology", f.morphology);
    putName(out, "attenuation", f.attenuation);
    putName(out, "confidence", f.confidence);
    putValue(out, "size_mm", f.size_mm);
    putText(out, "size_from", f.size_from);
    putValue(out, "height_mm", f.height_mm);
    putValue(out, "volume_ml", f.volume_ml);
    if (f.endoscope)
        out["endoscope_mm"] = {
            {"about", f.endoscope->about_mm}, {"least", f.endoscope->least_mm}, {"most", f.endoscope->most_mm}};
    for (const PriorSight& sight : f.sights)
        out["sights"].push_back(sightJson(sight));
    return out;
}

json toJson(const PriorReport& r)
{
    json out = {{"sop_uid", r.sop_uid},
                {"sop_class", r.sop_class},
                {"series_uid", r.series_uid},
                {"case", r.case_id},
                {"study", r.study},
                {"maker", r.maker},
                {"person", r.person},
                {"date", r.date},
                {"signed", r.is_signed},
                {"replaces", r.replaces},
                {"scans", json::array()},
                {"findings", json::array()},
                {"distension", json::array()},
                {"assessment", toJson(r.said)},
                {"not_read", r.not_read}};
    for (const PriorScan& s : r.scans)
        out["scans"].push_back({{"series_uid", s.series_uid},
                                {"position", s.position},
                                {"kernel", s.kernel},
                                {"slice_thickness_mm", s.slice_thickness_mm}});
    for (const PriorFinding& f : r.findings)
        out["findings"].push_back(toJson(f));
    for (const PriorPart& p : r.parts)
        out["distension"].push_back(
            {{"series_uid", p.series_uid}, {"part", nameOf(p.part)}, {"distension", nameOf(p.distension)}});
    return out;
}

std::string labelOf(const PriorReport& report, const PriorFinding& finding)
{
    constexpr std::size_t kYear = 4;
    std::array<char, 32> size{};
    if (finding.size_mm)
        std::snprintf(size.data(), size.size(), " %.1f mm", *finding.size_mm);
    const bool dated = printedDate(report.when()) != report.when();
    const std::string when = dated ? report.when().substr(0, kYear) : "earlier";
    return when + ": " + (finding.kind ? nameOf(*finding.kind) : finding.what) + size.data();
}

std::string inBrief(const PriorReport& r)
{
    std::string out = r.when().empty() ? "undated" : printedDate(r.when());
    out += ", " + (r.maker.empty() ? "of an unknown maker" : r.maker) + ": ";
    out += r.findings.empty()       ? "no findings"
           : r.findings.size() == 1 ? "1 finding"
                                    : std::to_string(r.findings.size()) + " findings";
    if (r.said.colon_category)
        out += ", " + nameOf(r.said.colon_category->category);
    return out;
}

}  // namespace vicon
