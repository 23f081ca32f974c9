#include "vicon/cases/marker_measures.h"

#include "vicon/core/geometry_json.h"

using nlohmann::json;

namespace vicon {

json toJson(const PlaneSize& s)
{
    return {{"diameter_mm", s.diameter_mm}, {"from_mm", pointToJson(s.from_mm)},     {"to_mm", pointToJson(s.to_mm)},
            {"area_mm2", s.area_mm2},       {"middle_mm", pointToJson(s.middle_mm)}, {"along", vectorToJson(s.along)},
            {"up", vectorToJson(s.up)}};
}

PlaneSize planeSizeFromJson(const json& json)
{
    return {json.at("diameter_mm").get<double>(), pointFromJson(json.at("from_mm")),   pointFromJson(json.at("to_mm")),
            json.at("area_mm2").get<double>(),    pointFromJson(json.at("middle_mm")), vectorFromJson(json.at("along")),
            vectorFromJson(json.at("up"))};
}

json toJson(const MarkerSize& s)
{
    json out = {{"straight_mm", s.straight_mm}, {"from_mm", pointToJson(s.from_mm)}, {"to_mm", pointToJson(s.to_mm)}};
    if (s.along_mm)
        out["along_mm"] = *s.along_mm;
    if (s.plane)
        out["plane"] = toJson(*s.plane);
    return out;
}

MarkerSize markerSizeFromJson(const json& json)
{
    MarkerSize size;
    size.straight_mm = json.at("straight_mm").get<double>();
    size.from_mm = pointFromJson(json.at("from_mm"));
    size.to_mm = pointFromJson(json.at("to_mm"));
    if (const auto along = json.find("along_mm"); along != json.end())
        size.along_mm = along->get<double>();
    if (const auto plane = json.find("plane"); plane != json.end())
        size.plane = planeSizeFromJson(*plane);
    return size;
}

json toJson(const DensitySample& s)
{
    return {{"position_mm", pointToJson(s.centre_mm)},
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
    sample.centre_mm = pointFromJson(json.at("position_mm"));
    sample.radius_mm = json.at("radius_mm").get<double>();
    sample.margin_mm = json.at("margin_mm").get<double>();
    sample.voxels = json.at("voxels").get<std::size_t>();
    sample.mean_hu = json.at("mean_hu").get<double>();
    sample.sd_hu = json.at("sd_hu").get<double>();
    sample.fat_fraction = json.at("fat_fraction").get<double>();
    sample.from_hu = histogram.at("from_hu").get<int>();
    sample.counts = histogram.at("counts").get<std::vector<std::size_t>>();
    return sample;
}

json toJson(const MarkerView& v)
{
    return {{"eye_mm", pointToJson(v.eye_mm)},
            {"forward", vectorToJson(v.forward)},
            {"up", vectorToJson(v.up)},
            {"station_mm", v.station_mm}};
}

MarkerView markerViewFromJson(const json& json)
{
    return {pointFromJson(json.at("eye_mm")), vectorFromJson(json.at("forward")), vectorFromJson(json.at("up")),
            json.at("station_mm").get<double>()};
}

}  // namespace vicon
