#include "vicon/cases/marker_measures.h"

#include <algorithm>

#include "json_fields.h"
#include "vicon/core/geometry_json.h"
#include "vicon/core/json_text.h"

using nlohmann::json;

namespace vicon {

json toJson(const PlaneSize& s)
{
    return {{"diameter_mm", s.diameter_mm}, {"from_mm", s.from_mm}, {"to_mm", s.to_mm}, {"area_mm2", s.area_mm2},
            {"middle_mm", s.middle_mm},     {"along", s.along},     {"up", s.up}};
}

PlaneSize planeSizeFromJson(const json& json)
{
    return {json.at("diameter_mm").get<double>(), json.at("from_mm").get<Point3>(),   json.at("to_mm").get<Point3>(),
            json.at("area_mm2").get<double>(),    json.at("middle_mm").get<Point3>(), json.at("along").get<Vector3>(),
            json.at("up").get<Vector3>()};
}

json toJson(const PolypSize& s)
{
    json out = {{"diameter_mm", s.diameter_mm}, {"least_mm", s.least_mm}, {"most_mm", s.most_mm},
                {"from_mm", s.from_mm},         {"to_mm", s.to_mm},       {"height_mm", s.height_mm},
                {"volume_ml", s.volume_ml},     {"rim_mm", s.rim_mm}};
    putValue(out, "volume_least_ml", s.volume_least_ml);
    putValue(out, "volume_most_ml", s.volume_most_ml);
    return out;
}

PolypSize polypSizeFromJson(const json& json)
{
    return {json.at("diameter_mm").get<double>(), json.at("least_mm").get<double>(),
            json.at("most_mm").get<double>(),     json.at("from_mm").get<Point3>(),
            json.at("to_mm").get<Point3>(),       json.at("height_mm").get<double>(),
            json.at("volume_ml").get<double>(),   number(json, "volume_least_ml"),
            number(json, "volume_most_ml"),       json.at("rim_mm").get<std::vector<Point3>>()};
}

double outsideOf_mm(const MarkerSize& size, Point3 place)
{
    const double radius_mm = distance(size.from_mm, size.to_mm) / 2;
    return std::max(0.0, distance(place, interpolate(size.from_mm, size.to_mm, 0.5)) - radius_mm);
}

json toJson(const MarkerSize& s)
{
    json out = {{"straight_mm", s.straight_mm}, {"from_mm", s.from_mm}, {"to_mm", s.to_mm}};
    if (s.in_slice)
        out["in_slice"] = true;
    if (s.along_mm)
        out["along_mm"] = *s.along_mm;
    if (s.plane)
        out["plane"] = toJson(*s.plane);
    if (s.polyp)
        out["polyp"] = toJson(*s.polyp);
    return out;
}

MarkerSize markerSizeFromJson(const json& json)
{
    MarkerSize size;
    size.straight_mm = json.at("straight_mm").get<double>();
    size.in_slice = json.value("in_slice", false);
    size.from_mm = json.at("from_mm").get<Point3>();
    size.to_mm = json.at("to_mm").get<Point3>();
    if (const auto along = json.find("along_mm"); along != json.end())
        size.along_mm = along->get<double>();
    if (const auto plane = json.find("plane"); plane != json.end())
        size.plane = planeSizeFromJson(*plane);
    if (const auto polyp = json.find("polyp"); polyp != json.end())
        size.polyp = polypSizeFromJson(*polyp);
    return size;
}

json toJson(const DensitySample& s)
{
    return {{"position_mm", s.centre_mm},
            {"radius_mm", s.radius_mm},
            {"margin_mm", s.margin_mm},
            {"voxels", s.voxels},
            {"mean_hu", s.mean_hu},
            {"sd_hu", s.sd_hu},
            {"fat_fraction", s.fat_fraction},
            {"histogram", {{"from_hu", s.from_hu}, {"bin_hu", DensitySample::kBin_hu}, {"counts", s.counts}}}};
}

DensitySample densitySampleFromJson(const json& json)
{
    const auto& histogram = json.at("histogram");
    DensitySample sample;
    sample.centre_mm = json.at("position_mm").get<Point3>();
    sample.radius_mm = json.at("radius_mm").get<double>();
    sample.margin_mm = json.at("margin_mm").get<double>();
    sample.voxels = wholeCount(json.at("voxels"));
    sample.mean_hu = json.at("mean_hu").get<double>();
    sample.sd_hu = json.at("sd_hu").get<double>();
    sample.fat_fraction = json.at("fat_fraction").get<double>();
    sample.from_hu = wholeNumber(histogram.at("from_hu"));
    for (const auto& count : histogram.at("counts").get_ref<const nlohmann::json::array_t&>())
        sample.counts.push_back(wholeCount(count));
    return sample;
}

json toJson(const MarkerView& v)
{
    return {{"eye_mm", v.eye_mm}, {"forward", v.forward}, {"up", v.up}, {"station_mm", v.station_mm}};
}

MarkerView markerViewFromJson(const json& json)
{
    return {json.at("eye_mm").get<Point3>(), json.at("forward").get<Vector3>(), json.at("up").get<Vector3>(),
            json.at("station_mm").get<double>()};
}

}  // namespace vicon
