#include <QAction>
#include <QComboBox>

#include "beside_view.h"
#include "reading_window.h"
#include "saved_view.h"
#include "vicon/viewer/model/correspondence.h"

namespace vicon::viewer {
namespace {

ColonScale scaleOf(const OpenScan& scan)
{
    return {scan.files.frames().length_mm(), scan.files.parts()};
}

/// The saved one, unless the path was made anew meanwhile and runs elsewhere there.
double stationOf(const OpenScan& scan, const SavedView& view)
{
    constexpr double kOtherPath_mm = 20;  // a colon's radius; a piece of it that was added or dropped is longer
    const SkeletonFoot nearest = scan.files.skeleton().nearest(view.pose.eye_mm);
    const double off_mm = distance(scan.files.frames().at(view.station_mm).position_mm, view.pose.eye_mm);
    return off_mm > nearest.distance_mm + kOtherPath_mm ? nearest.station_mm : view.station_mm;
}

}  // namespace

double ReadingWindow::corresponding_mm(const OpenScan& from, double station_mm, const OpenScan& to)
{
    return correspondingStation_mm(scaleOf(from), station_mm, scaleOf(to));
}

void ReadingWindow::connectBeside()
{
    connect(&session_, &CaseSession::besideOpened, this, [this] {
        beside_place_.reset();
        tell({});
        drawBeside(true);
    });
    connect(&studio_, &Studio::besideDrawn, this, [this](const Picture& picture, const Studio::Shown& shown) {
        beside_shown_ = shown;
        beside_->endoscopic()->showPicture(picture);
    });
    connect(beside_->endoscopic(), &PictureView::resized, this, [this] { drawBeside(true); });
    connect(beside_->endoscopic(), &PictureView::clicked, this, &ReadingWindow::clickedBeside);
    connect(beside_->endoscopic(), &PictureView::turned, this,
            [this](int steps) { emit navigation_->stepWanted(5.0 * steps); });
    connect(beside_->slice(), &SliceView::failed, this, &ReadingWindow::warn);
    connect(beside_->slice(), &SliceView::pointClicked, this, [this](Point3 point, Qt::KeyboardModifiers modifiers) {
        if (session_.beside())
            placed(*session_.beside(), beside_shown_.place, point, modifiers);
    });
    connect(window_choice_, &QComboBox::currentTextChanged, beside_->slice(),
            [this](const QString& name) { beside_->slice()->setWindow(windowPreset(name.toStdString())); });
}

void ReadingWindow::setBeside(bool on)
{
    compare_->setChecked(on);
    beside_->setVisible(on && !enlarged_);
    if (!on) {
        session_.closeBeside();
        return;
    }
    if (!session_.scan() || session_.beside())
        return;  // it follows when the leading scan is there
    for (const ScanRecord& other : session_.scans())
        if (other.id != session_.scan()->record.id) {
            tell(tr("Reading the other scan ..."));
            session_.openBeside(other.id);
            return;
        }
    compare_->setChecked(false);
    beside_->hide();
    warn(tr("This case has no other scan that can be read."));
}

NavigationState ReadingWindow::besidePlace() const
{
    const OpenScan& scan = *session_.beside();
    if (beside_place_)
        return {beside_place_->pose, beside_place_->station_mm, beside_place_->clearance_mm, false, false};
    const double station = corresponding_mm(*session_.scan(), navigator()->state().station_mm, scan);
    const bool to_caecum = (navigator()->heading() == Heading::caecum) != navigator()->looksBack();
    const ViewPose view =
        poseAtStation(scan.files.frames(), scan.lumen, station, to_caecum ? Heading::caecum : Heading::rectum);
    return {view.pose, station, view.clearance_mm, false, false};
}

void ReadingWindow::drawBeside(bool still)
{
    if (!session_.scan() || !session_.beside() || !beside_->isVisible())
        return;
    const NavigationState at = besidePlace();
    const auto scan = session_.sharedBeside();
    const Studio::Wish wish = wishFor(*scan, at, beside_->endoscopic()->pictureSize(), still);
    studio_.drawBeside(scan, wish);
    beside_->slice()->look(scan, beside_place_ ? beside_focus_.value_or(at.pose.eye_mm) : at.pose.eye_mm, at.pose,
                           wish.request.markers);
}

void ReadingWindow::clickedBeside(Pixel at, Qt::KeyboardModifiers modifiers)
{
    if (!session_.beside() || !beside_shown_.isOf(session_.sharedBeside()))
        return;
    if (const auto point = wallAt(*session_.beside(), beside_shown_, at);
        point && placed(*session_.beside(), beside_shown_.place, *point, modifiers, true))
        return;
    ScanRequest request;
    request.scan_id = session_.beside()->record.id;
    changeScan(request);
}

void ReadingWindow::showPairOf(const Marker& marker)
{
    beside_place_.reset();
    const auto partner = session_.marker(marker.pair);
    if (!partner || !session_.beside() || partner->scan_id != session_.beside()->record.id)
        return;
    beside_place_ = viewFor(*session_.beside(), *partner);
    beside_focus_ = partner->position_mm;
}

ViewPose ReadingWindow::viewFor(const OpenScan& scan, const Marker& marker)
{
    if (const auto saved = savedView(marker); saved && scan.lumen.inside(saved->pose.eye_mm))
        return {saved->pose, stationOf(scan, *saved), scan.lumen.clearance_mm(saved->pose.eye_mm), true};
    return poseForPoint(scan.files.skeleton(), scan.files.frames(), scan.lumen, marker.position_mm);
}

}  // namespace vicon::viewer
