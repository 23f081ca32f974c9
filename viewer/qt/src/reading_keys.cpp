#include <QApplication>
#include <QClipboard>
#include <QStatusBar>

#include "reading_window.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace vicon::viewer {
namespace {

constexpr double kReach_mm = 500;     // of a click into the endoscopic view
constexpr double kFromLumen_mm = 15;  // a click on a slice this near to the lumen moves the eye as well

nlohmann::json jsonOf(Vector3 v)
{
    return {v.x, v.y, v.z};
}

Vector3 vectorFrom(const nlohmann::json& json)
{
    return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

nlohmann::json viewOf(const NavigationState& state)
{
    return {{"eye_mm", jsonOf(state.pose.eye_mm - Point3{})},
            {"forward", jsonOf(state.pose.forward)},
            {"up", jsonOf(state.pose.up)},
            {"station_mm", state.station_mm}};
}

/// A view that was saved with a marker, and the station of its eye, which is not the marker's.
struct SavedView {
    Pose pose;
    double station_mm = 0;
};

/// Nothing where there is none or it makes no sense.
std::optional<SavedView> savedView(const Marker& marker)
{
    try {
        const auto& view = marker.extra.at("view");
        SavedView saved{{Point3{} + vectorFrom(view.at("eye_mm")), normalized(vectorFrom(view.at("forward"))), {}},
                        view.at("station_mm").get<double>()};
        saved.pose.up = uprightOn(saved.pose.forward, vectorFrom(view.at("up")));
        if (length(saved.pose.forward) > 0.5)
            return saved;
    } catch (const nlohmann::json::exception&) {
        // written by something else
    }
    return std::nullopt;
}

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
    if (pairing_) {
        const auto known = session_.marker(*pairing_);
        pairing_.reset();
        if (!known)
            return;
        const Marker& first = *known;
        if (first.scan_id == marker.scan_id) {
            warn(tr("A pair is one finding in two scans; both markers lie in the same one."));
            return;
        }
        session_.pairMarkers(first, marker);
        return;
    }
    if (!navigator())
        return;
    if (marker.scan_id != session_.scan()->record.id) {
        warn(tr("This marker lies in the other scan; change to it first."));
        return;
    }
    const auto view = savedView(marker);
    if (!view) {
        lookAt(marker.position_mm);
        return;
    }
    beginPass();
    navigator()->lookFrom(view->pose, view->station_mm);
    focus_ = marker.position_mm;
    moved(true);
}

bool ReadingWindow::placed(Point3 point, Qt::KeyboardModifiers modifiers, bool on_wall)
{
    if (measuredAt(point, on_wall))
        return true;
    if (moving_) {
        const auto before = session_.marker(*moving_);
        moving_.reset();
        if (!before)
            return true;
        Marker after = *before;
        after.position_mm = point;
        after.extra.erase("view");
        session_.changeMarker(*before, after, true);
        return true;
    }
    if (!armed_ && !(modifiers & Qt::ShiftModifier))
        return false;
    Marker marker;
    marker.scan_id = session_.scan()->record.id;
    marker.position_mm = point;
    marker.color = armed_.value_or(MarkerColor::red);
    marker.extra["view"] = viewOf(navigator()->state());
    session_.addMarker(marker);
    arm({});
    return true;
}

void ReadingWindow::clickedEndoscopic(Pixel at, Qt::KeyboardModifiers modifiers)
{
    if (!navigator() || shown_lens_.width == 0)
        return;
    const Vector3 ray = rayThrough(shown_pose_, shown_lens_, at);
    const auto far = distanceToWall_mm(session_.scan()->lumen, shown_pose_.eye_mm, ray, kReach_mm);
    if (!far)
        return;
    const Point3 point = shown_pose_.eye_mm + ray * *far;
    placed(point, modifiers, true);
    focus_ = point;
    showPlace();
}

void ReadingWindow::clickedSlice(Point3 point, Qt::KeyboardModifiers modifiers)
{
    if (!navigator())
        return;
    if (placed(point, modifiers)) {
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
    const PathFrames& path = session_.scan()->files.frames();
    double station = 0, least = 1e300;
    for (double s = 0; s <= path.length_mm(); s += 1) {
        const Pixel p = shown_overview_.toPixel(path.at(s).position_mm);
        if (const double d = std::hypot(p.x - at.x, p.y - at.y); d < least) {
            least = d;
            station = s;
        }
    }
    if (placed(path.at(station).position_mm, modifiers))
        return;
    emit navigation_->jumpWanted(station);
}

void ReadingWindow::pair(const Marker& marker)
{
    if (pairOf(marker).empty()) {
        pairing_ = marker.id;
        tell(tr("Choose the same finding in the other scan"));
    } else {
        session_.partMarkers(marker);
    }
}

void ReadingWindow::arm(std::optional<MarkerColor> color)
{
    armed_ = color;
    if (!color) {
        moving_.reset();
        pairing_.reset();
    }
    stopMeasuring();
    setPickCursor(color.has_value());
    tell(color ? tr("Click where the %1 marker shall be").arg(QString::fromStdString(nameOf(*color))) : QString());
}

void ReadingWindow::setPickCursor(bool on)
{
    for (QWidget* view : std::initializer_list<QWidget*>{endoscopic_, overview_, transverse_, coronal_, sagittal_})
        view->setCursor(on ? Qt::CrossCursor : Qt::ArrowCursor);
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
