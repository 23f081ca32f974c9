#include "comparison/comparison_tool.h"

#include <QAction>

#include "comparison/beside_view.h"
#include "reading/kept_place.h"
#include "reading/reading.h"
#include "widgets/kept_settings.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
namespace {
constexpr const char* kOn = "beside";
}

ComparisonTool::ComparisonTool(Reading& reading) : ReadingTool(reading), view_(new BesideView) {}

void ComparisonTool::addTo(ReadingLayout& layout)
{
    reading_.views().addBeside(view_);
    on_ = layout.addSwitch(ReadingMenu::view, tr("Both scans side by side"), QKeySequence("C"));
    connect(on_, &QAction::triggered, this, &ComparisonTool::compare);
    connect(&reading_.views(), &ReadingViews::arranged, this, &ComparisonTool::arrange);
    connect(&reading_.session(), &CaseSession::besideOpened, this, [this] {
        partner_.reset();
        reading_.say({});
        draw(true);
    });
    connect(&reading_.drawing(), &DrawingThread::besideDrawn, this,
            [this](const Picture& picture, const ShownPicture& shown) {
                shown_ = shown;
                view_->endoscopic()->showPicture(picture);
            });
    connectView();
}

void ComparisonTool::connectView()
{
    PictureView* endoscopic = view_->endoscopic();
    SliceView* slice = view_->slice();
    connect(endoscopic, &PictureView::resized, this, [this] { draw(true); });
    connect(endoscopic, &PictureView::clicked, this, &ComparisonTool::clicked);
    connect(endoscopic, &PictureView::turned, &reading_, [this](int steps) { emit reading_.stepWanted(steps); });
    connect(slice, &SliceView::failed, &reading_, &Reading::warn);
    connect(slice, &SliceView::pointClicked, this, [this](Point3 point, Qt::KeyboardModifiers modifiers) {
        if (const OpenScan* scan = reading_.session().beside())
            reading_.click({*scan, shown_.place, point, modifiers, false});
    });
    connect(&reading_, &Reading::windowChanged, slice, &SliceView::setWindow);
    connect(&reading_, &Reading::awaitingClick, this, [endoscopic, slice](bool on) {
        endoscopic->setPicking(on);
        slice->setPicking(on);
    });
}

void ComparisonTool::restore()
{
    on_->setChecked(keptSetting(keptKey(reading_.session().record(), kOn)).toBool());
}

QVariantMap ComparisonTool::kept() const
{
    return {{keptKey(reading_.session().record(), kOn), on_->isChecked()}};
}

void ComparisonTool::scanOpened(const Arrival&)
{
    partner_.reset();
    if (on_->isChecked())
        compare(true);
}

void ComparisonTool::arrange()
{
    view_->setVisible(on_->isChecked() && reading_.views().roomBeside());
    draw(true);
}

void ComparisonTool::compare(bool on)
{
    CaseSession& session = reading_.session();
    on_->setChecked(on);
    view_->setVisible(on && reading_.views().roomBeside());
    if (!on) {
        session.closeBeside();
        return;
    }
    if (!reading_.scan() || session.beside())
        return;  // it follows when the leading scan is there
    for (const ScanRecord& other : session.scans())
        if (other.id != reading_.scan()->record.id) {
            reading_.say(tr("Reading the other scan ..."));
            session.openBeside(other.id);
            return;
        }
    on_->setChecked(false);
    view_->hide();
    reading_.warn(tr("This case has no other scan that can be read."));
}

NavigationState ComparisonTool::place() const
{
    const OpenScan& scan = *reading_.session().beside();
    if (partner_)
        return {partner_->view.pose, partner_->view.station_mm, partner_->view.clearance_mm, false, false};
    const Navigator& leading = *reading_.navigator();
    const double station = correspondingStation_mm(*reading_.scan(), leading.state().station_mm, scan);
    const bool to_caecum = (leading.heading() == Heading::caecum) != leading.looksBack();
    const ViewPose view =
        poseAtStation(scan.files.frames(), scan.lumen, station, to_caecum ? Heading::caecum : Heading::rectum);
    return {view.pose, station, view.clearance_mm, false, false};
}

void ComparisonTool::draw(bool still)
{
    if (!reading_.scan() || !reading_.session().beside() || !view_->isVisible())
        return;
    const NavigationState at = place();
    const auto scan = reading_.session().sharedBeside();
    const EndoscopicRequest request = reading_.requestFor(*scan, at, view_->endoscopic()->pictureSize(), still);
    reading_.drawing().drawBeside(scan, request);
    view_->slice()->look(scan, partner_ ? partner_->at_mm : at.pose.eye_mm, at.pose, request.snapshot.markers);
}

void ComparisonTool::clicked(Pixel at, Qt::KeyboardModifiers modifiers)
{
    const auto scan = reading_.session().sharedBeside();
    if (!scan || !shown_.isOf(scan))
        return;
    if (const auto point = wallAt(*scan, shown_.place.pose, shown_.lens, at);
        point && reading_.click({*scan, shown_.place, *point, modifiers, true}))
        return;
    ScanRequest request;
    request.scan_id = scan->record.id;
    reading_.changeScan(request);
}

void ComparisonTool::markerShown(const Marker& marker)
{
    partner_.reset();
    const OpenScan* scan = reading_.session().beside();
    const auto partner = reading_.session().marker(marker.pair);
    if (partner && scan && partner->scan_id == scan->record.id)
        partner_ = Partner{viewOfMarker(*scan, *partner), partner->position_mm};
}

}  // namespace vicon::viewer
