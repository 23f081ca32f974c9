// The line that is shown: of what was measured last or of a marker, and while an end of it is dragged.
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

void MeasuringTool::drag(int end, const std::optional<ClickedPoint>& to, bool released)
{
    if (!shown_ || shown_->way_mm.empty())
        return;  // given up meanwhile
    if (!to || to->scan.record.id != shown_->scan_id) {
        if (released) {
            shown_->dragged_mm.clear();
            showLine();
            reading_.say(tr("No wall is shown there: the size stays as it was"));
        }
        return;
    }
    Point3 from = shown_->way_mm.front(), last = shown_->way_mm.back();
    (end == 0 ? from : last) = to->at_mm;
    if (released) {
        // In a slice, or where fluid stands as acquired, an end need not lie on the wall.
        measure(from, last, shown_->size.along_mm && to->on_wall, *to);
        return;
    }
    shown_->dragged_mm = {from, last};
    showLine();
}

MeasuringTool::Shown MeasuringTool::shownOf(const Marker& marker)
{
    return {marker.scan_id, *marker.size, {marker.size->from_mm, marker.size->to_mm}, marker.id, {}};
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
    if (!shown_ || shown_->way_mm.empty())
        return std::nullopt;
    if (const auto& ends = shown_->dragged_mm; !ends.empty())
        return MeasuredLine{shown_->scan_id, ends, lengthText(distance(ends.front(), ends.back())), {}};
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
    reading_.setLine(line());
}

}  // namespace vicon::viewer
