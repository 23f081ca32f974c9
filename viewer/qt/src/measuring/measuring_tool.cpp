#include "measuring/measuring_tool.h"

#include <QMessageBox>
#include <QPushButton>

#include "measuring/line_from_inside.h"
#include "reading/reading.h"
#include "widgets/length_text.h"
#include "window/reading_layout.h"

namespace vicon::viewer {

void MeasuringTool::addTo(ReadingLayout& layout)
{
    layout.addAction(ReadingMenu::edit, tr("Measure between two clicks"), QKeySequence("M"), [this] { start(); });
    layout.addAction(ReadingMenu::edit, tr("Outline the polyp at the next click"), QKeySequence("Shift+M"),
                     [this] { startOutline(); });
    connect(&reading_.session(), &CaseSession::outlined, this, &MeasuringTool::outlined);
    connect(&reading_.session(), &CaseSession::measured, this, &MeasuringTool::measured);
    for (const auto changed : {&CaseSession::besideOpened, &CaseSession::besideClosed})
        connect(&reading_.session(), changed, this, &MeasuringTool::forgetClosed);
    connect(&reading_, &Reading::lineDragged, this, &MeasuringTool::drag);
    connectViews();
}

/// Those of the scan that is read; the tools that have other views do the same there.
void MeasuringTool::connectViews()
{
    PictureView* endoscopic = reading_.views().endoscopic();
    const auto draw = [this, endoscopic] {
        endoscopic->setCalliper(lineFromInside(reading_.line(), reading_.sharedScan(), reading_.shown()));
    };
    connect(&reading_, &Reading::endoscopicShown, this, draw);
    connect(&reading_, &Reading::lineChanged, this, draw);
    connect(endoscopic, &PictureView::endDragged, this, [this](int end, Pixel at, bool released) {
        const ShownPicture& picture = reading_.shown();
        const auto wall = picture.isOf(reading_.sharedScan()) ? picture.wallAt(at) : std::nullopt;
        std::optional<ClickedPoint> to;
        if (wall)
            to.emplace(ClickedPoint{*reading_.scan(), picture.place, *wall, {}, !picture.acquired});
        emit reading_.lineDragged(end, to, released);
    });
    for (SliceView* slice : reading_.views().slices()) {
        connect(&reading_, &Reading::lineChanged, slice, [this, slice] { slice->setLine(reading_.line()); });
        connect(slice, &SliceView::lineDragged, this, [this](int end, Point3 to, bool released) {
            if (reading_.scan())
                emit reading_.lineDragged(end, ClickedPoint{*reading_.scan(), reading_.place(), to, {}, false},
                                          released);
        });
    }
}

/// Where the two scans changed places the line goes along with its own.
void MeasuringTool::scanOpened(const Arrival& arrival)
{
    if (std::holds_alternative<SamePlace>(arrival.place))
        shown_.reset();  // read again: the wall may be another one
    forgetClosed();
}

void MeasuringTool::forgetClosed()
{
    CaseSession& session = reading_.session();
    const auto* under_way = reading_.interaction().inUse<Measure>();
    if (under_way && !under_way->ends_mm.empty() && !session.openScan(under_way->scan_id))
        reading_.interaction().scanChanged();
    if (shown_ && !session.openScan(shown_->scan_id))
        shown_.reset();
    showLine();
}

void MeasuringTool::start()
{
    if (!reading_.navigator())
        return;
    reading_.navigator()->fly(0);
    shown_.reset();
    reading_.begin(Measure{}, tr("Measure: click on the two ends, on the wall or in a slice; or arrows and Return"));
}

void MeasuringTool::startOutline()
{
    if (!reading_.navigator())
        return;
    reading_.navigator()->fly(0);
    shown_.reset();
    reading_.begin(OutlinePolyp{}, tr("Outline: click on a polyp, on the wall or in a slice; or arrows and Return"));
}

bool MeasuringTool::act(const ClickMeaning& meaning, const ClickedPoint& point)
{
    if (std::holds_alternative<OutlineHere>(meaning)) {
        reading_.toolChanged();
        reading_.say(tr("Outlining ..."));
        shown_ = Shown{point.scan.record.id, {}, {}, {}, {}};
        reading_.session().outlinePolyp(point.scan.record.id, point.at_mm);
        return true;
    }
    if (const auto* ends = std::get_if<MeasureBetween>(&meaning)) {
        reading_.toolChanged();
        shown_.reset();  // a marker that was shown meanwhile keeps its size
        measure(ends->from_mm, ends->to_mm, ends->on_wall, point);
        return true;
    }
    if (std::holds_alternative<AwaitOtherEnd>(meaning)) {
        showLine();
        reading_.say(tr("Measure: click on the other end"));
        return true;
    }
    const auto* refusal = std::get_if<Refuse>(&meaning);
    const bool of_end = refusal && refusal->why == Refuse::Why::end_in_other_scan;
    if (of_end)
        reading_.warn(tr("Both ends of a size lie in one scan: click in the one of the first end."));
    return of_end;
}

void MeasuringTool::escape()
{
    shown_.reset();
    showLine();
}

void MeasuringTool::measure(Point3 from, Point3 to, bool on_wall, const ClickedPoint& last)
{
    if (!shown_)
        shown_.emplace();
    shown_->scan_id = last.scan.record.id;
    shown_->way_mm = {from, to};
    shown_->dragged_mm.clear();
    shown_->size = {.straight_mm = distance(from, to), .from_mm = from, .to_mm = to};
    showLine();
    if (on_wall) {
        reading_.say(tr("Measuring ..."));
        reading_.session().measure(shown_->scan_id, from, to, last.from.pose.eye_mm);
    } else {
        finish();
    }
}

void MeasuringTool::measured(const std::string& scan_id, const WallDistance& size,
                             const std::optional<PlaneSize>& plane)
{
    if (!shown_ || shown_->scan_id != scan_id)
        return;  // given up meanwhile
    shown_->way_mm = size.way_mm;
    shown_->size = {.straight_mm = size.straight_mm,
                    .along_mm = size.along_mm,
                    .from_mm = size.way_mm.front(),
                    .to_mm = size.way_mm.back(),
                    .plane = plane};
    finish();
}

/// Where there is no outline the two ends are asked for instead.
void MeasuringTool::outlined(const std::string& scan_id, const PolypOutline& outline)
{
    if (!shown_ || shown_->scan_id != scan_id)
        return;  // given up meanwhile
    if (!outline.size) {
        start();
        reading_.warn(tr("The polyp cannot be outlined: %1. Click on its two ends.")
                          .arg(QString::fromStdString(outline.trouble)));
        return;
    }
    shown_ = Shown{scan_id, sizeOf(outline), {outline.size->from_mm, outline.size->to_mm}, {}, {}};
    finish();
}

void MeasuringTool::finish()
{
    showLine();
    const MarkerSize size = shown_->size;
    if (!shown_->marker_id.empty()) {
        keep(shown_->marker_id, size);
        return;
    }
    const auto marker = reading_.markerNear(shown_->scan_id, shown_->way_mm);
    const auto scan = reading_.session().openScan(shown_->scan_id);
    if (scan && scan->record.case_id != reading_.session().record().id)
        reading_.say(sizeText(size) + tr("; not kept: the earlier examination takes no markers"));
    else if (!marker)
        reading_.say(sizeText(size) + tr("; no marker beside it to keep it with"));
    else if (marker->size)
        ask(*marker, size);
    else
        keep(marker->id, size);
}

void MeasuringTool::ask(const Marker& marker, const MarkerSize& size)
{
    const QString id = QString::fromStdString(marker.id);
    auto* box = new QMessageBox(
        QMessageBox::Question, tr("Replace the size?"),
        tr("%1 has a size already: %2.\n\nThe new one: %3.").arg(id, sizeText(*marker.size), sizeText(size)),
        QMessageBox::NoButton, reading_.views().window());
    box->setObjectName("replaceSize");
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->addButton(tr("&Replace it"), QMessageBox::AcceptRole)->setObjectName("replace");
    auto* leave = box->addButton(tr("&Keep the old one"), QMessageBox::RejectRole);
    leave->setObjectName("keepOld");
    box->setDefaultButton(leave);
    box->setEscapeButton(leave);
    connect(box, &QMessageBox::accepted, this, [this, marker_id = marker.id, size] { keep(marker_id, size); });
    connect(box, &QMessageBox::rejected, this, [this, id, marker_id = marker.id] {
        if (const auto kept = reading_.session().marker(marker_id))
            markerShown(*kept);
        reading_.say(tr("%1 keeps its size").arg(id));
    });
    box->open();
}

void MeasuringTool::keep(const std::string& marker_id, const MarkerSize& size)
{
    const auto marker = reading_.session().marker(marker_id);
    if (!marker)
        return;
    if (shown_)
        shown_->marker_id = marker_id;
    Marker after = *marker;
    after.size = size;
    reading_.session().changeMarker(*marker, after, false,
                                    tr("%1; kept with %2").arg(sizeText(size), QString::fromStdString(marker_id)));
}

}  // namespace vicon::viewer
