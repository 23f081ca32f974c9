#include "measuring/measuring_tool.h"

#include <QMessageBox>
#include <QPushButton>

#include "measuring/line_from_inside.h"
#include "reading/reading.h"
#include "widgets/length_text.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
namespace {

constexpr double kSame_mm = 1e-6;
constexpr double kWorthSaying_mm = 0.05;  // what a tenth of a millimetre shows

bool same(const MarkerSize& a, const MarkerSize& b)
{
    return distance(a.from_mm, b.from_mm) < kSame_mm && distance(a.to_mm, b.to_mm) < kSame_mm;
}

}  // namespace

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
