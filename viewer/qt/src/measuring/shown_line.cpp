// The line that is shown: of what was measured last or of a marker, and while an end of it is dragged.
#include <algorithm>
#include <utility>

#include "measuring/measuring_tool.h"
#include "reading/reading.h"
#include "widgets/length_text.h"

namespace vicon::viewer {
namespace {

constexpr double kSame_mm = 1e-6;
constexpr double kWorthSaying_mm = 0.05;  // what a tenth of a millimetre shows

bool same(const MarkerSize& a, const MarkerSize& b)
{
    return distance(a.from_mm, b.from_mm) < kSame_mm && distance(a.to_mm, b.to_mm) < kSame_mm;
}

}  // namespace

std::vector<Point3> MeasuringTool::endsNow() const
{
    if (!shown_->dragged_mm.empty())
        return shown_->dragged_mm;
    if (const auto request = requests_.find(shown_->request); request != requests_.end())
        return request->second.ends_mm;
    return {};
}

void MeasuringTool::drag(int end, const std::optional<ClickedPoint>& to, GripDrag how)
{
    if (!line() || reading_.interaction().inUse<Measure>())
        return;  // given up meanwhile
    const auto goBack = [this](const QString& why) {
        shown_->dragged_mm.clear();
        showLine();
        reading_.say(why);
    };
    if (how == GripDrag::broken_off) {
        goBack(tr("The drag was broken off: the size stays as it was"));
        return;
    }
    if (!to || to->scan.record.id != shown_->scan_id) {
        if (how == GripDrag::released)
            goBack(tr("No wall is shown there: the size stays as it was"));
        return;
    }
    const bool over_wall = shown_->size.along_mm || requests_.count(shown_->request);
    std::vector<Point3> ends_mm = endsNow();
    if (ends_mm.empty())
        ends_mm = {shown_->way_mm.front(), shown_->way_mm.back()};
    (end == 0 ? ends_mm.front() : ends_mm.back()) = to->at_mm;
    if (how == GripDrag::held) {
        shown_->dragged_mm = ends_mm;
        showLine();
    } else if (distance(ends_mm.front(), ends_mm.back()) < to->scan.voxel_mm()) {
        goBack(tr("The two ends were the same place: the size stays as it was"));
    } else {
        // In a slice, or where fluid stands as acquired, an end need not lie on the wall.
        measure(ends_mm.front(), ends_mm.back(), over_wall && to->on_wall, *to);
    }
}

MeasuringTool::Shown MeasuringTool::shownOf(const Marker& marker) const
{
    const auto request = std::find_if(requests_.begin(), requests_.end(),
                                      [&](const auto& one) { return one.second.marker_id == marker.id; });
    return {marker.scan_id,
            *marker.size,
            {marker.size->from_mm, marker.size->to_mm},
            marker.id,
            request == requests_.end() ? 0 : request->first,
            {}};
}

void MeasuringTool::markerShown(const Marker& marker)
{
    shown_.reset();
    if (marker.size)
        shown_ = shownOf(marker);
    showLine();
}

// What was undone, done again or changed by another reader is drawn as it is now.
void MeasuringTool::markersChanged()
{
    if (!reading_.session().busy())
        for (const Shown& result : std::exchange(waiting_, {}))
            offer(result);
    if (!shown_ || shown_->marker_id.empty() || reading_.session().busy())
        return;
    const auto marker = reading_.session().marker(shown_->marker_id);
    if (!marker || !marker->size)
        shown_.reset();
    else if (!same(*marker->size, shown_->size))
        shown_ = shownOf(*marker);
    showLine();
}

std::optional<MeasuredLine> MeasuringTool::line() const
{
    if (const auto* under_way = reading_.interaction().inUse<Measure>())
        return under_way->ends_mm.empty() ? std::nullopt
                                          : std::optional(MeasuredLine{under_way->scan_id, under_way->ends_mm, {}, {}});
    if (!shown_)
        return std::nullopt;
    if (const auto ends = endsNow(); !ends.empty())
        return MeasuredLine{shown_->scan_id, ends, lengthText(distance(ends.front(), ends.back())), {}};
    if (shown_->way_mm.empty())
        return std::nullopt;
    const double largest_mm = largestDiameter_mm(shown_->size);
    QString text = lengthText(shown_->size.straight_mm);
    if (largest_mm > shown_->size.straight_mm + kWorthSaying_mm)
        text += tr(" (largest %1)").arg(lengthText(largest_mm));
    MeasuredLine line{shown_->scan_id, shown_->way_mm, text, {}};
    if (const auto& polyp = shown_->size.polyp) {
        line.text += tr(" (%1 to %2)").arg(polyp->least_mm, 0, 'f', 1).arg(polyp->most_mm, 0, 'f', 1);
        line.rim_mm = polyp->rim_mm;
    }
    return line;
}

void MeasuringTool::showLine()
{
    if (shown_ && shown_->way_mm.empty() && !requests_.count(shown_->request))
        shown_.reset();  // it was not measured
    reading_.setLine(line());
}

}  // namespace vicon::viewer
