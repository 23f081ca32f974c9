#include "measuring/measuring_tool.h"

#include "reading/reading.h"
#include "widgets/length_text.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
void MeasuringTool::addTo(ReadingLayout& layout)
{
    layout.addAction(ReadingMenu::edit, tr("Measure between two clicks"), QKeySequence("M"), [this] { start(); });
    connect(&reading_.session(), &CaseSession::measured, this, &MeasuringTool::show);
    connect(&reading_, &Reading::endoscopicShown, this, &MeasuringTool::drawLine);
}

void MeasuringTool::start()
{
    line_mm_.clear();
    drawLine();
    reading_.begin(Measure{}, tr("Measure: click on the two ends, on the wall or in a slice; or arrows and Return"));
}

bool MeasuringTool::act(const ClickMeaning& meaning, const ClickedPoint&)
{
    if (const auto* ends = std::get_if<MeasureBetween>(&meaning)) {
        measure(*ends);
        return true;
    }
    if (std::holds_alternative<AwaitOtherEnd>(meaning)) {
        reading_.say(tr("Measure: click on the other end"));
        return true;
    }
    const auto* refusal = std::get_if<Refuse>(&meaning);
    const bool of_end = refusal && refusal->why == Refuse::Why::end_in_other_scan;
    if (of_end)
        reading_.warn(tr("Both ends of a size lie in the scan that is being read."));
    return of_end;
}

void MeasuringTool::escape()
{
    line_mm_.clear();
    drawLine();
}

void MeasuringTool::measure(const MeasureBetween& ends)
{
    reading_.toolChanged();
    if (ends.on_wall) {
        reading_.say(tr("Measuring ..."));
        reading_.session().measure(ends.from_mm, ends.to_mm, reading_.shown().place.pose.eye_mm);
    } else {
        show({distance(ends.from_mm, ends.to_mm), 0, {ends.from_mm, ends.to_mm}}, {});
    }
}

void MeasuringTool::show(const WallDistance& size, const std::optional<PlaneSize>& plane)
{
    line_mm_ = size.way_mm;
    drawLine();
    QString text = tr("%1 straight").arg(lengthText(size.straight_mm));
    if (size.along_mm > 0)
        text += tr(", %1 along the wall").arg(lengthText(size.along_mm));
    if (plane)
        text += tr(", %1 largest in the best plane").arg(lengthText(plane->diameter_mm));
    const auto marker = reading_.markerNear(size.way_mm);
    if (!marker) {
        reading_.say(text + tr("; no marker beside it to keep it with"));
        return;
    }
    Marker after = *marker;
    after.size = {.straight_mm = size.straight_mm,
                  .along_mm = size.along_mm > 0 ? std::optional(size.along_mm) : std::nullopt,
                  .from_mm = size.way_mm.front(),
                  .to_mm = size.way_mm.back(),
                  .plane = plane};
    reading_.session().changeMarker(*marker, after, false,
                                    tr("%1; kept with %2").arg(text, QString::fromStdString(marker->id)));
}

void MeasuringTool::drawLine()
{
    const ShownPicture& shown = reading_.shown();
    QVector<QLineF> lines;
    for (std::size_t n = 1; n < line_mm_.size(); ++n) {
        const Projected a = project(shown.place.pose, shown.lens, line_mm_[n - 1]);
        const Projected b = project(shown.place.pose, shown.lens, line_mm_[n]);
        if (a.depth_mm > 0 && b.depth_mm > 0)
            lines << QLineF(a.at.x, a.at.y, b.at.x, b.at.y);
    }
    reading_.views().endoscopic()->setLines(lines);
}

}  // namespace vicon::viewer
