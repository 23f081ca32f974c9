#include "saved_view.h"

namespace vicon::viewer {
namespace {

nlohmann::json jsonOf(Vector3 v)
{
    return {v.x, v.y, v.z};
}

Vector3 vectorFrom(const nlohmann::json& json)
{
    return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

}  // namespace

nlohmann::json viewOf(const SnapshotResult& place)
{
    return {{"eye_mm", jsonOf(place.pose.eye_mm - Point3{})},
            {"forward", jsonOf(place.pose.forward)},
            {"up", jsonOf(place.pose.up)},
            {"station_mm", place.station_mm}};
}

std::optional<SavedView> savedView(const Marker& marker)
{
    try {
        const auto& view = marker.extra.at("view");
        SavedView saved{{Point3{} + vectorFrom(view.at("eye_mm")), normalized(vectorFrom(view.at("forward"))), {}},
                        view.at("station_mm").get<double>()};
        saved.pose.up = uprightOn(saved.pose.forward, vectorFrom(view.at("up")));
        if (length(saved.pose.forward) > 0.5)
            return saved;
    } catch (const nlohmann::json::exception&) {
        // written by something else
    }
    return std::nullopt;
}

}  // namespace vicon::viewer
