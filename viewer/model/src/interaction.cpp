#include "vicon/viewer/model/interaction.h"

#include <algorithm>

namespace vicon::viewer {

bool Interaction::awaitsClick() const
{
    return !inUse<Idle>() && !inUse<PairMarker>();
}

ClickMeaning Interaction::measureAt(const PickedPoint& point)
{
    auto& measure = std::get<Measure>(tool_);
    if (measure.ends_mm.empty())
        measure.scan_id = point.scan_id;
    else if (measure.scan_id != point.scan_id)
        return Refuse{Refuse::Why::end_in_other_scan, {}};
    else if (distance(measure.ends_mm.front(), point.at_mm) < point.voxel_mm)
        return Refuse{Refuse::Why::end_in_same_place, {}};
    measure.ends_mm.push_back(point.at_mm);
    measure.on_wall = measure.on_wall && point.on_wall;
    if (measure.ends_mm.size() < 2)
        return AwaitOtherEnd{};
    const MeasureBetween meaning{measure.ends_mm[0], measure.ends_mm[1], measure.on_wall};
    finish();
    return meaning;
}

ClickMeaning Interaction::click(const PickedPoint& point)
{
    if (const auto* correct = inUse<Correct>())
        return CorrectHere{correct->kind};
    if (inUse<Measure>())
        return measureAt(point);
    if (inUse<OutlinePolyp>()) {
        finish();
        return OutlineHere{};
    }
    if (const auto* move = inUse<MoveMarker>()) {
        const MoveMarker moved = *move;
        finish();
        if (moved.scan_id != point.scan_id)
            return Refuse{Refuse::Why::marker_of_other_scan, moved.id};
        return MoveMarkerHere{moved.id};
    }
    const auto* place = inUse<PlaceMarker>();
    if (!place && !point.wants_marker)
        return ShowPoint{};
    const AddMarker meaning{place ? place->color : MarkerColor::red};
    finish();
    return meaning;
}

ChoiceMeaning Interaction::choose(const Marker& marker)
{
    const auto* pair = inUse<PairMarker>();
    if (!pair)
        return ShowMarker{};
    const PairMarker first = *pair;
    finish();
    if (first.scan_id == marker.scan_id)
        return RefusePair{};
    return PairWith{first.id};
}

void Interaction::scanChanged()
{
    if (inUse<Measure>())
        tool_ = Measure{};
}

void Interaction::markersChanged(const std::vector<Marker>& markers)
{
    const auto* move = inUse<MoveMarker>();
    const auto* pair = inUse<PairMarker>();
    if (!move && !pair)
        return;
    const std::string& id = move ? move->id : pair->id;
    if (std::none_of(markers.begin(), markers.end(), [&](const Marker& marker) { return marker.id == id; }))
        tool_ = Idle{};
}

}  // namespace vicon::viewer
