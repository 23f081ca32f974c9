#include <QApplication>
#include <QClipboard>
#include <QStatusBar>

#include "beside_view.h"
#include "reading_window.h"
#include "saved_view.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace vicon::viewer {
namespace {

constexpr double kReach_mm = 500;     // of a click into the endoscopic view
constexpr double kFromLumen_mm = 15;  // a click on a slice this near to the lumen moves the eye as well

}  // namespace

void ReadingWindow::lookAt(Point3 point)
{
    const OpenScan& scan = *session_.scan();
    if (scan.lumen.nearestInside(point, kFromLumen_mm).found) {
        const ViewPose view = poseForPoint(scan.files.skeleton(), scan.files.frames(), scan.lumen, point);
        beginPass();
        navigator()->lookFrom(view.pose, view.station_mm);
    }
    focus_ = point;
    moved(true);
}

void ReadingWindow::flyTo(const Marker& marker)
{
    const ChoiceMeaning meaning = interaction_.choose(marker);
    if (const auto* pair = std::get_if<PairWith>(&meaning)) {
        if (const auto first = session_.marker(pair->id))
            session_.pairMarkers(*first, marker);
    } else if (std::holds_alternative<RefusePair>(meaning)) {
        warn(tr("A pair is one finding in two scans; both markers lie in the same one."));
    } else {
        showMarker(marker);
    }
}

void ReadingWindow::showMarker(const Marker& marker)
{
    if (!navigator())
        return;
    if (marker.scan_id != session_.scan()->record.id) {
        ScanRequest request;
        request.scan_id = marker.scan_id;
        request.marker_id = marker.id;
        changeScan(request);
        return;
    }
    const ViewPose view = viewFor(*session_.scan(), marker);
    beginPass();
    navigator()->lookFrom(view.pose, view.station_mm);
    focus_ = marker.position_mm;
    showPairOf(marker);
    moved(true);
}

bool ReadingWindow::placed(const OpenScan& scan, const SnapshotResult& from, Point3 point,
                           Qt::KeyboardModifiers modifiers, bool on_wall)
{
    PickedPoint picked;
    picked.at_mm = point;
    picked.scan_id = scan.record.id;
    picked.in_scan_read = &scan == session_.scan();
    picked.on_wall = on_wall;
    picked.wants_marker = modifiers & Qt::ShiftModifier;
    return act(interaction_.click(picked), scan, from, point);
}

bool ReadingWindow::act(const ClickMeaning& meaning, const OpenScan& scan, const SnapshotResult& from, Point3 point)
{
    if (const auto* add = std::get_if<AddMarker>(&meaning))
        addMarker(add->color, scan, from, point);
    else if (const auto* move = std::get_if<MoveMarkerHere>(&meaning))
        moveMarker(move->id, point);
    else if (const auto* correction = std::get_if<CorrectHere>(&meaning))
        correct(scan, correction->kind, point);
    else if (const auto* size = std::get_if<MeasureBetween>(&meaning))
        measure(*size);
    else if (const auto* refusal = std::get_if<Refuse>(&meaning))
        refuse(*refusal);
    else if (std::holds_alternative<AwaitOtherEnd>(meaning))
        tell(tr("Measure: click on the other end"));
    return !std::holds_alternative<ShowPoint>(meaning);
}

void ReadingWindow::addMarker(MarkerColor color, const OpenScan& scan, const SnapshotResult& from, Point3 point)
{
    Marker marker;
    marker.scan_id = scan.record.id;
    marker.position_mm = point;
    marker.color = color;
    marker.view = viewOf(from);
    session_.addMarker(marker);
    endTool();
}

void ReadingWindow::moveMarker(const std::string& id, Point3 point)
{
    endTool();
    const auto before = session_.marker(id);
    if (!before)
        return;
    Marker after = *before;
    after.position_mm = point;
    after.view.reset();
    session_.changeMarker(*before, after, true);
}

void ReadingWindow::refuse(const Refuse& refusal)
{
    if (refusal.why == Refuse::Why::end_in_other_scan) {
        warn(tr("Both ends of a size lie in the scan that is being read."));
        return;
    }
    endTool();
    warn(tr("%1 lies in the other scan and cannot be moved to this one.")
             .arg(QString::fromStdString(refusal.marker_id)));
}

std::optional<Point3> ReadingWindow::wallAt(const OpenScan& scan, const Studio::Shown& shown, Pixel at)
{
    const Point3 eye_mm = shown.place.pose.eye_mm;
    const Vector3 ray = rayThrough(shown.place.pose, shown.lens, at);
    const auto far = distanceToWall_mm(scan.lumen, eye_mm, ray, kReach_mm);
    return far ? std::optional(eye_mm + ray * *far) : std::nullopt;
}

void ReadingWindow::clickedEndoscopic(Pixel at, Qt::KeyboardModifiers modifiers)
{
    if (!navigator())
        return;
    if (!shown_.isOf(session_.sharedScan())) {
        tell(tr("The picture of this scan is still to come; click again when it is there."));
        return;
    }
    const auto point = wallAt(*session_.scan(), shown_, at);
    if (!point)
        return;
    placed(*session_.scan(), shown_.place, *point, modifiers, true);
    focus_ = point;
    showPlace();
}

void ReadingWindow::clickedSlice(Point3 point, Qt::KeyboardModifiers modifiers)
{
    if (!navigator())
        return;
    if (placed(*session_.scan(), place(), point, modifiers)) {
        focus_ = point;
        showPlace();
    } else {
        lookAt(point);
    }
}

void ReadingWindow::clickedOverview(Pixel at, Qt::KeyboardModifiers modifiers)
{
    if (!navigator() || !overview_shown_)
        return;
    if (const SkeletonTree& tree = session_.scan()->files.tree(); !tree.empty()) {
        clickedTree(tree, at, modifiers);
        return;
    }
    const PathFrames& path = session_.scan()->files.frames();
    double station = 0, least = 1e300;
    for (double s = 0; s <= path.length_mm(); s += 1) {
        const Pixel p = shown_overview_.toPixel(path.at(s).position_mm);
        if (const double d = std::hypot(p.x - at.x, p.y - at.y); d < least) {
            least = d;
            station = s;
        }
    }
    if (placed(*session_.scan(), place(), path.at(station).position_mm, modifiers))
        return;
    emit navigation_->jumpWanted(station);
}

void ReadingWindow::pair(const Marker& marker)
{
    if (marker.pair.empty())
        begin(PairMarker{marker.id, marker.scan_id}, tr("Choose the same finding in the other scan"));
    else
        session_.partMarkers(marker);
}

void ReadingWindow::startPlacing(MarkerColor color)
{
    begin(PlaceMarker{color},
          tr("Click where the %1 marker shall be, or arrows and Return").arg(QString::fromStdString(nameOf(color))));
}

void ReadingWindow::startMoving(const Marker& marker)
{
    begin(MoveMarker{marker.id, marker.scan_id},
          tr("Click on the new place of %1, or arrows and Return").arg(QString::fromStdString(marker.id)));
}

void ReadingWindow::begin(const ToolInUse& tool, const QString& prompt)
{
    interaction_.begin(tool);
    forgetCircle();
    showTool();
    tell(prompt);
}

void ReadingWindow::showTool()
{
    endoscopic_->setCircling(interaction_.inUse<CircleFinding>() != nullptr);
    setPickCursor(interaction_.awaitsClick());
}

void ReadingWindow::setPickCursor(bool on)
{
    for (PictureView* view : std::initializer_list<PictureView*>{endoscopic_, overview_, transverse_, coronal_,
                                                                 sagittal_, beside_->endoscopic(), beside_->slice()})
        view->setPicking(on);
    if (on && !qobject_cast<PictureView*>(focusWidget()))
        endoscopic_->setFocus(Qt::ShortcutFocusReason);  // Return clicks in a picture
}

void ReadingWindow::setMode(NavigationMode mode)
{
    if (!navigator())
        return;
    navigator()->setMode(mode);
    updateSteering();
    moved(true);
}

void ReadingWindow::fly(int direction)
{
    if (!navigator())
        return;
    if (direction != 0 && navigator()->mode() == NavigationMode::free)
        navigator()->setMode(NavigationMode::planned);  // on along the path from where the eye is
    navigator()->fly(direction);
    moved(false);
}

void ReadingWindow::turnAbout()
{
    if (!navigator())
        return;
    beginPass();
    navigator()->setHeading(navigator()->heading() == Heading::caecum ? Heading::rectum : Heading::caecum);
    moved(true);
}

void ReadingWindow::goToEnd(Heading end)
{
    if (!navigator())
        return;
    navigator()->setHeading(end == Heading::caecum ? Heading::rectum : Heading::caecum);
    navigator()->setLookBack(false);
    emit navigation_->jumpWanted(end == Heading::caecum ? session_.scan()->files.frames().length_mm() : 0);
}

void ReadingWindow::sayWhereItIsNarrow(double wanted_mm)
{
    constexpr double kOff_mm = 5;
    if (navigator() && navigator()->mode() == NavigationMode::guided &&
        std::abs(navigator()->state().station_mm - wanted_mm) > kOff_mm)
        tell(tr("There it is too narrow for the guided flight; the planned one (P) reaches it."));
}

void ReadingWindow::updateSteering()
{
    if (!navigator())
        return;
    const auto axis = [this](int plus, int minus) { return double(keys_.count(plus)) - double(keys_.count(minus)); };
    const auto limited = [](double v) { return std::clamp(v, -1.0, 1.0); };
    Steering steering;
    if (navigator()->mode() == NavigationMode::guided)
        steering.pull = axis(Qt::Key_W, Qt::Key_S);
    else
        steering.thrust_forward = axis(Qt::Key_W, Qt::Key_S);
    steering.thrust_right = axis(Qt::Key_D, Qt::Key_A);
    steering.turn_right = limited(axis(Qt::Key_Right, Qt::Key_Left) + mouse_steering_.x());
    steering.turn_up = limited(axis(Qt::Key_Up, Qt::Key_Down) + mouse_steering_.y());
    navigator()->steer(steering);
}

void ReadingWindow::snapshot(bool to_clipboard)
{
    if (endoscopic_->image().isNull())
        return;
    if (to_clipboard) {
        QApplication::clipboard()->setImage(endoscopic_->image());
        tell(tr("Picture copied"));
        return;
    }
    session_.savePicture(endoscopic_->image());
}

}  // namespace vicon::viewer
