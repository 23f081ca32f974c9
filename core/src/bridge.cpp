#include "vicon/core/bridge.h"

#include "vicon/core/geometry_json.h"

namespace vicon {
namespace {

constexpr double kSame_mm = 0.5;  // less than a voxel: the same end of the same bridge

}  // namespace

nlohmann::json toJson(const Bridge& bridge)
{
    nlohmann::json out = {{"from_mm", bridge.from_mm},       {"to_mm", bridge.to_mm},   {"length_mm", bridge.length_mm},
                          {"confidence", bridge.confidence}, {"reason", bridge.reason}, {"certain", bridge.certain}};
    if (!bridge.path_mm.empty())
        out["path_mm"] = bridge.path_mm;
    return out;
}

Bridge bridgeFromJson(const nlohmann::json& json)
{
    Bridge bridge;
    bridge.from_mm = json.at("from_mm").get<Point3>();
    bridge.to_mm = json.at("to_mm").get<Point3>();
    bridge.length_mm = json.at("length_mm").get<double>();
    bridge.confidence = json.at("confidence").get<double>();
    bridge.reason = json.at("reason").get<std::string>();
    bridge.certain = json.at("certain").get<bool>();
    if (const auto path = json.find("path_mm"); path != json.end())
        bridge.path_mm = path->get<std::vector<Point3>>();
    return bridge;
}

bool isSameBridge(const Bridge& a, const Bridge& b)
{
    return distance(a.from_mm, b.from_mm) < kSame_mm && distance(a.to_mm, b.to_mm) < kSame_mm;
}

}  // namespace vicon
