#include "session/saved_view.h"

namespace vicon::viewer {

MarkerView viewOf(const SnapshotResult& place)
{
    return {place.pose.eye_mm, place.pose.forward, place.pose.up, place.station_mm};
}

std::optional<SavedView> savedView(const Marker& marker)
{
    if (!marker.view)
        return std::nullopt;
    SavedView saved{{marker.view->eye_mm, normalized(marker.view->forward), {}}, marker.view->station_mm};
    saved.pose.up = uprightOn(saved.pose.forward, marker.view->up);
    constexpr double kUnit = 0.5;  // a direction of no length points nowhere
    return length(saved.pose.forward) > kUnit ? std::optional(saved) : std::nullopt;
}

}  // namespace vicon::viewer
