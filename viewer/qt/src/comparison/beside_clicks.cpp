// What the mouse does in the views of the scan beside, and what is measured there.
#include <cmath>

#include "comparison/beside_view.h"
#include "comparison/comparison_tool.h"
#include "measuring/line_from_inside.h"
#include "reading/reading.h"

namespace vicon::viewer {

void ComparisonTool::connectView()
{
    PictureView* endoscopic = view_->endoscopic();
    SliceView* slice = view_->slice();
    connect(endoscopic, &PictureView::resized, this, [this] { draw(true); });
    connect(endoscopic, &PictureView::clicked, this, &ComparisonTool::clicked);
    connect(view_->overview(), &PictureView::resized, this, [this] { draw(true); });
    connect(view_->overview(), &PictureView::clicked, this, &ComparisonTool::clickedOverview);
    connect(endoscopic, &PictureView::turned, &reading_, [this](int steps) { emit reading_.stepWanted(steps); });
    connect(slice, &SliceView::failed, &reading_, &Reading::warn);
    connect(slice, &SliceView::pointClicked, this, [this](Point3 point, Qt::KeyboardModifiers modifiers) {
        if (const OpenScan* scan = clickableScan())
            reading_.click({*scan, {}, point, modifiers, false});
    });
    connect(&reading_, &Reading::sliceLookChanged, slice, &SliceView::setLook);
    connect(&reading_, &Reading::cleansedChanged, slice, &SliceView::setCleansed);
    connect(slice, &SliceView::trackWanted, &reading_, &Reading::trackWanted);
    connect(slice, &SliceView::windowDragged, &reading_, &Reading::windowDragged);
    connect(&reading_, &Reading::awaitingClick, this, [endoscopic, slice](bool on) {
        endoscopic->setPicking(on);
        slice->setPicking(on);
    });
}

/// What is measured in the scan beside is drawn there, and its ends are dragged there.
void ComparisonTool::connectLine()
{
    const auto drag = [this](int end, const std::optional<Point3>& to, const std::optional<SnapshotResult>& from,
                             bool on_wall, GripDrag how) {
        const OpenScan* scan = reading_.session().beside();
        const bool there = to && scan;
        emit reading_.lineDragged(
            end, there ? std::optional(ClickedPoint{*scan, from, *to, {}, on_wall}) : std::nullopt, how);
    };
    connect(&reading_, &Reading::lineChanged, this, &ComparisonTool::drawLine);
    connect(view_->endoscopic(), &PictureView::endDragged, this, [this, drag](int end, Pixel at, GripDrag how) {
        const bool there = shown_.isOf(reading_.session().sharedBeside());
        drag(end, there ? shown_.wallAt(at) : std::nullopt, shown_.place, !shown_.acquired, how);
    });
    connect(view_->overview(), &PictureView::endDragged, this, [this](int, Pixel, GripDrag how) {
        if (how == GripDrag::released)
            reading_.warn(tr("The projection has no depth: drag the end on the wall or in a slice."));
    });
    connect(view_->slice(), &SliceView::lineDragged, this,
            [drag](int end, Point3 to, GripDrag how) { drag(end, to, {}, false, how); });
}

void ComparisonTool::drawLine()
{
    view_->slice()->setLine(reading_.line());
    view_->endoscopic()->setCalliper(lineFromInside(reading_.line(), reading_.session().sharedBeside(), shown_));
    const auto& line = reading_.line();
    const OpenScan* scan = reading_.session().beside();
    const bool of_it = line && scan && line->scan_id == scan->record.id && shown_overview_;
    view_->overview()->setCalliper(of_it ? inProjection(*line, shown_overview_->view) : std::nullopt);
}

const OpenScan* ComparisonTool::clickableScan()
{
    const Interaction& next = reading_.interaction();
    const bool measures = next.inUse<Measure>() || next.inUse<OutlinePolyp>();
    if (!reading_.session().besideIsPrior() || measures)
        return reading_.session().beside();
    reading_.say(tr("The earlier examination is looked at and measured, not marked."));
    return nullptr;
}

void ComparisonTool::clicked(Pixel at, Qt::KeyboardModifiers modifiers)
{
    const auto scan = reading_.session().sharedBeside();
    if (!scan || !shown_.isOf(scan) || !clickableScan())
        return;
    const bool awaited = reading_.interaction().awaitsClick();
    const auto point = shown_.wallAt(at);
    if ((point && reading_.click({*scan, shown_.place, *point, modifiers, !shown_.acquired})) || awaited)
        return;
    ScanRequest request;
    request.scan_id = scan->record.id;
    reading_.changeScan(request);
}

void ComparisonTool::clickedOverview(Pixel at)
{
    const auto scan = reading_.session().sharedBeside();
    if (!scan || !map_ || !shown_overview_)
        return;
    if (reading_.interaction().inUse<Measure>()) {
        reading_.warn(tr("The projection has no depth: measure on the wall or in a slice."));
        return;
    }
    const PathFrames& path = scan->files.frames();
    double station = 0, least = 1e300;
    for (double s = 0; s <= path.length_mm(); s += 1) {
        const Pixel p = shown_overview_->view.toPixel(path.at(s).position_mm);
        if (const double d = std::hypot(p.x - at.x, p.y - at.y); d < least) {
            least = d;
            station = s;
        }
    }
    emit reading_.jumpWanted(map_->reversed().at(station).station_mm);
}

}  // namespace vicon::viewer
