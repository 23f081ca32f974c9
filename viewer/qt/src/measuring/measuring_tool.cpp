#include "measuring/measuring_tool.h"

#include <utility>

#include "measuring/line_from_inside.h"
#include "reading/reading.h"
#include "window/reading_layout.h"

namespace vicon::viewer {

void MeasuringTool::addTo(ReadingLayout& layout)
{
    layout.addAction(ReadingMenu::edit, tr("Measure between two clicks"), QKeySequence("M"), [this] { start(); });
    layout.addAction(ReadingMenu::edit, tr("Outline the polyp at the next click"), QKeySequence("Shift+M"),
                     [this] { startOutline(); });
    connect(&reading_.session(), &CaseSession::outlined, this, &MeasuringTool::outlined);
    connect(&reading_.session(), &CaseSession::measured, this, &MeasuringTool::measured);
    connect(&reading_.session(), &CaseSession::notMeasured, this, &MeasuringTool::notMeasured);
    connect(&reading_.session(), &CaseSession::measuringGivenUp, this, [this] {
        given_up_ = given_up_ || !requests_.empty();
        requests_.clear();
        showLine();
    });
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
    connect(endoscopic, &PictureView::endDragged, this, [this](int end, Pixel at, GripDrag drag) {
        const ShownPicture& picture = reading_.shown();
        const auto wall = picture.isOf(reading_.sharedScan()) ? picture.wallAt(at) : std::nullopt;
        std::optional<ClickedPoint> to;
        if (wall)
            to.emplace(ClickedPoint{*reading_.scan(), picture.place, *wall, {}, !picture.acquired});
        emit reading_.lineDragged(end, to, drag);
    });
    for (SliceView* slice : reading_.views().slices()) {
        connect(&reading_, &Reading::lineChanged, slice, [this, slice] { slice->setLine(reading_.line()); });
        connect(slice, &SliceView::lineDragged, this, [this](int end, Point3 to, GripDrag drag) {
            if (reading_.scan())
                emit reading_.lineDragged(end, ClickedPoint{*reading_.scan(), {}, to, {}, false}, drag);
        });
    }
}

/// Where the two scans changed places the line goes along with its own.
void MeasuringTool::scanOpened(const Arrival& arrival)
{
    if (std::holds_alternative<SamePlace>(arrival.place))
        shown_.reset();  // read again: the wall may be another one
    forgetClosed();
    sayWhatWasGivenUp();
}

void MeasuringTool::forgetClosed()
{
    CaseSession& session = reading_.session();
    const auto* under_way = reading_.interaction().inUse<Measure>();
    if (under_way && !under_way->ends_mm.empty() && !session.openScan(under_way->scan_id))
        reading_.interaction().scanChanged();
    for (const auto& [number, request] : std::map(requests_))
        if (!session.openScan(request.scan_id)) {
            giveUp(number);
            reading_.warn(tr("The scan was closed before the size was there: measure it again."));
        }
    if (shown_ && !session.openScan(shown_->scan_id))
        shown_.reset();
    showLine();
}

void MeasuringTool::sayWhatWasGivenUp()
{
    if (std::exchange(given_up_, false))
        reading_.warn(tr("Another scan was opened before the size was there: measure it again."));
}

void MeasuringTool::start()
{
    if (!reading_.navigator())
        return;
    reading_.navigator()->fly(0);
    shown_.reset();
    const QString anew = giveUpNew() ? tr("The last one was given up. ") : QString();
    reading_.begin(Measure{},
                   anew + tr("Measure: click on the two ends, on the wall or in a slice; or arrows and Return"));
}

void MeasuringTool::startOutline()
{
    if (!reading_.navigator())
        return;
    reading_.navigator()->fly(0);
    shown_.reset();
    const QString anew = giveUpNew() ? tr("The last one was given up. ") : QString();
    reading_.begin(OutlinePolyp{},
                   anew + tr("Outline: click on a polyp, on the wall or in a slice; or arrows and Return"));
}

bool MeasuringTool::act(const ClickMeaning& meaning, const ClickedPoint& point)
{
    const std::string& scan_id = point.scan.record.id;
    if (std::holds_alternative<OutlineHere>(meaning)) {
        reading_.toolChanged();
        reading_.say(tr("Outlining ..."));
        shown_ = Shown{scan_id, {}, {}, {}, ++last_request_, {}};
        requests_[last_request_] = {scan_id, {}, {}};
        showLine();
        reading_.session().outlinePolyp(last_request_, scan_id, point.at_mm);
        return true;
    }
    if (const auto* ends = std::get_if<MeasureBetween>(&meaning)) {
        reading_.toolChanged();
        shown_ = Shown{scan_id, {}, {}, {}, 0, {}};  // a marker that was shown meanwhile keeps its size
        measure(ends->from_mm, ends->to_mm, ends->on_wall, point);
        return true;
    }
    if (std::holds_alternative<AwaitOtherEnd>(meaning)) {
        showLine();
        reading_.say(tr("Measure: click on the other end"));
        return true;
    }
    const auto* refusal = std::get_if<Refuse>(&meaning);
    if (!refusal)
        return false;
    if (refusal->why == Refuse::Why::end_in_other_scan)
        reading_.warn(tr("Both ends of a size lie in one scan: click in the one of the first end."));
    else if (refusal->why == Refuse::Why::end_in_same_place)
        reading_.say(tr("That is the place of the first end: click on the other end, a voxel or more from it."));
    else
        return false;
    return true;
}

void MeasuringTool::escape()
{
    requests_.clear();  // the session has given them up
    shown_.reset();
    showLine();
}

void MeasuringTool::giveUp(int request)
{
    if (requests_.erase(request))
        reading_.session().giveUpMeasuring(request);
}

bool MeasuringTool::giveUpNew()
{
    bool any = false;
    for (const auto& [number, request] : std::map(requests_))
        if (request.marker_id.empty()) {
            giveUp(number);
            any = true;
        }
    return any;
}

void MeasuringTool::measure(Point3 from, Point3 to, bool on_wall, const ClickedPoint& last)
{
    giveUp(shown_->request);
    shown_->request = ++last_request_;
    shown_->dragged_mm.clear();
    if (!on_wall || !last.from) {
        Shown result = *shown_;
        result.way_mm = {from, to};
        result.size = {.straight_mm = distance(from, to), .in_slice = !last.from, .from_mm = from, .to_mm = to};
        take(result);
        return;
    }
    requests_[last_request_] = {shown_->scan_id, shown_->marker_id, {from, to}};
    showLine();
    reading_.say(tr("Measuring ..."));
    reading_.session().measure(last_request_, shown_->scan_id, from, to, last.from->pose.eye_mm);
}

std::optional<MeasuringTool::Request> MeasuringTool::finished(int request)
{
    auto found = requests_.extract(request);
    return found ? std::optional(found.mapped()) : std::nullopt;
}

void MeasuringTool::measured(int number, const WallDistance& size, const std::optional<PlaneSize>& plane)
{
    const auto request = finished(number);
    if (!request)
        return;
    const auto scan = reading_.session().openScan(request->scan_id);
    if (scan && size.straight_mm < scan->voxel_mm()) {
        showLine();
        reading_.warn(tr("On the wall the two ends are less than a voxel apart; measure them in a slice."));
        return;
    }
    const MarkerSize as_marker{.straight_mm = size.straight_mm,
                               .along_mm = size.along_mm,
                               .from_mm = size.way_mm.front(),
                               .to_mm = size.way_mm.back(),
                               .plane = plane};
    take({request->scan_id, as_marker, size.way_mm, request->marker_id, number, {}});
}

void MeasuringTool::notMeasured(int request)
{
    requests_.erase(request);
    showLine();  // the size that was kept
}

/// Where there is no outline the two ends are asked for instead, unless the reader does something else by now.
void MeasuringTool::outlined(int number, const PolypOutline& outline)
{
    const auto request = finished(number);
    if (!request)
        return;
    if (outline.size) {
        take({request->scan_id, sizeOf(outline), {outline.size->from_mm, outline.size->to_mm}, {}, number, {}});
        return;
    }
    const QString why = tr("The polyp cannot be outlined: %1.").arg(QString::fromStdString(outline.trouble));
    if (shown_ && shown_->request == number && reading_.interaction().inUse<Idle>()) {
        start();
        reading_.warn(why + tr(" Click on its two ends."));
    } else {
        reading_.warn(why + tr(" M measures it between its two ends."));
    }
}

}  // namespace vicon::viewer
