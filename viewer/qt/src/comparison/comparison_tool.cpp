#include "comparison/comparison_tool.h"

#include <QAction>
#include <cmath>
#include <utility>

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
    connect(on_, &QAction::triggered, this, &ComparisonTool::switched);
    connect(&reading_.views(), &ReadingViews::arranged, this, &ComparisonTool::arrange);
    connect(&reading_.views(), &ReadingViews::laidOut, this, &ComparisonTool::followLayout);
    connect(&reading_.session(), &CaseSession::besideOpened, this, [this] {
        map_.reset();
        shown_ = {};
        shown_overview_.reset();
        const std::string& position = reading_.session().beside()->caption.position;
        view_->clear(tr("%1: this picture is still to come").arg(QString::fromStdString(position)));
        reading_.say({});
        showPartner();
        arrange();
    });
    connect(&reading_.session(), &CaseSession::besideClosed, this, &ComparisonTool::arrange);
    connect(&reading_, &Reading::partnerWanted, this, [this](const Marker& partner) {
        partner_markers_ = {partner};
        showPartner();
        draw(true);
    });
    connect(&reading_.drawing(), &DrawingThread::overviewDrawn, this,
            [this](const Picture& picture, const ShownProjection& shown) {
                if (!shown.isOf(reading_.session().sharedBeside()))
                    return;
                shown_overview_ = shown;
                view_->overview()->showPicture(picture);
                view_->overview()->noteWhereElsewhere(shown.eye_mm, eye_mm_);
                drawLine();
            });
    connect(&reading_.drawing(), &DrawingThread::besideDrawn, this,
            [this](const Picture& picture, const ShownPicture& shown) {
                if (!shown.isOf(reading_.session().sharedBeside()))
                    return;  // another scan is beside by now
                shown_ = shown;
                view_->endoscopic()->showPicture(picture);
                view_->endoscopic()->noteWhereElsewhere(shown.place.pose.eye_mm, eye_mm_);
                drawLine();
            });
    connectView();
    connectLine();
}

void ComparisonTool::restore()
{
    if (!keptSetting(readerKey(kOn)).toBool())
        return;  // the layout that the case is hung in may have asked already
    by_layout_ = false;
    on_->setChecked(true);
}

QVariantMap ComparisonTool::kept() const
{
    return {{readerKey(kOn), on_->isChecked() && !by_layout_}};
}

void ComparisonTool::scanLeft()
{
    left_ = reading_.sharedScan();
}

void ComparisonTool::scanOpened(const Arrival& arrival)
{
    pointLeft();
    map_.reset();
    came_to_.reset();
    const auto left = std::exchange(left_, {});
    if (const auto* from = std::get_if<CorrespondingPlace>(&arrival.place);
        from && left && haveSamePlaces(*left, *reading_.scan())) {
        const StationInterval place = reading_.session().mapBetween(*left, *reading_.scan()).at(from->station_mm);
        came_to_mm_ = place.station_mm;
        came_to_ = samePlace(tr("same place as %1").arg(left->caption.position.c_str()).toStdString(),
                             reading_.scan()->files.skeleton(), place);
        reading_.say(tr("The same place: within %1 to %2 mm from the %3 with a probability of 80 %")
                         .arg(place.least_mm, 0, 'f', 0)
                         .arg(place.most_mm, 0, 'f', 0)
                         .arg(reading_.organWords().first_end.c_str()));
    }
    if (on_->isChecked())
        compare(true);
}

void ComparisonTool::annotate(SnapshotRequest& request, const OpenScan& scan) const
{
    constexpr double kThere_mm = 1;
    if (came_to_ && &scan == reading_.scan() &&
        std::abs(reading_.navigator()->state().station_mm - came_to_mm_) < kThere_mm)
        request.priors.push_back(*came_to_);
}

/// A layout of both scans has the other one, and takes it along when it goes.
void ComparisonTool::followLayout(bool elsewhere)
{
    const ViewLayout layout = reading_.views().layoutNow();
    view_->slice()->setPlane(reading_.views().plane());
    if (elsewhere && layout != ViewLayout::both_scans)  // which makes them alike
        view_->favour(layout != ViewLayout::three_d_first);
    const bool wanted = layout == ViewLayout::both_scans;
    if (wanted && !on_->isChecked()) {
        by_layout_ = true;
        compare(true);
    } else if (!wanted && std::exchange(by_layout_, false)) {
        compare(false);
    }
}

void ComparisonTool::arrange()
{
    const bool wanted = on_->isChecked() || reading_.session().besideIsPrior();
    view_->setVisible(wanted && reading_.views().roomBeside());
    draw(true);
}

const ScanRecord* ComparisonTool::otherAfter(const std::string& beside) const
{
    bool passed = beside.empty();
    for (const ScanRecord& other : reading_.session().scans()) {
        if (passed && other.id != reading_.scan()->record.id)
            return &other;
        passed = passed || other.id == beside;
    }
    return nullptr;
}

void ComparisonTool::switched(bool on)
{
    CaseSession& session = reading_.session();
    const std::string beside = session.besideWanted();
    const ScanRecord* next = !on && reading_.scan() && !beside.empty() ? otherAfter(beside) : nullptr;
    if (!next) {
        compare(on);
        return;
    }
    on_->setChecked(true);
    reading_.say(tr("Reading the other scan ..."));
    session.openBeside(next->id);
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
    if (session.besideIsPrior())
        session.closeBeside();
    if (!reading_.scan() || !session.besideWanted().empty())
        return;  // it follows when the leading scan is there
    if (const ScanRecord* other = otherAfter({})) {
        reading_.say(tr("Reading the other scan ..."));
        session.openBeside(other->id);
        return;
    }
    on_->setChecked(false);
    view_->hide();
    reading_.warn(tr("This case has no other scan that can be read."));
}

StationInterval ComparisonTool::corresponding() const
{
    return map_->at(reading_.navigator()->state().station_mm);
}

NavigationState ComparisonTool::place() const
{
    const OpenScan& scan = *reading_.session().beside();
    if (partner_)
        return {partner_->view.pose, partner_->view.station_mm, partner_->view.clearance_mm, false, false};
    const Navigator& leading = *reading_.navigator();
    const double station = corresponding().station_mm;
    const bool to_caecum = (leading.heading() == Heading::caecum) != leading.looksBack();
    const ViewPose view =
        poseAtStation(scan.files.frames(), scan.lumen, station, to_caecum ? Heading::caecum : Heading::rectum);
    return {view.pose, station, view.clearance_mm, false, false};
}

void ComparisonTool::draw(bool still)
{
    if (reading_.scan() && reading_.session().beside() && view_->isVisible())
        drawBeside(still);
}

void ComparisonTool::drawBeside(bool still)
{
    const auto scan = reading_.session().sharedBeside();
    if (!haveSamePlaces(*reading_.scan(), *scan)) {
        compare(false);
        reading_.warn(
            tr("The %1 has no centreline: the same place of another scan cannot be told.")
                .arg(QString::fromStdString(
                    (reading_.scan()->files.hasPath() ? *scan : *reading_.scan()).files.words().organ.name())));
        return;
    }
    if (!map_)
        map_ = reading_.session().mapBetween(*reading_.scan(), *scan);
    const StationInterval same = corresponding();
    const NavigationState at = place();
    eye_mm_ = at.pose.eye_mm;
    if (shown_.isOf(scan))
        view_->endoscopic()->noteWhereElsewhere(shown_.place.pose.eye_mm, eye_mm_);
    EndoscopicRequest request = reading_.requestFor(*scan, at, view_->endoscopic()->pictureSize(), still);
    const std::string label = tr("same place, 80 %").toStdString();
    request.snapshot.priors.push_back(samePlace(label, scan->files.skeleton(), same));
    reading_.drawing().drawBeside(scan, request);
    SnapshotRequest overview = request.snapshot;
    view_->slice()->look(scan, partner_ ? partner_->at_mm : at.pose.eye_mm, at.pose, overview.markers, overview.priors);
    sayPlace(same);
    const QSize size = view_->overview()->pictureSize();
    overview.width = size.width();
    overview.height = size.height();
    if (view_->overview()->height() == 0)
        return;
    if (shown_overview_)
        view_->overview()->noteWhereElsewhere(shown_overview_->eye_mm, eye_mm_);
    reading_.drawing().drawBesideOverview(scan, overview, request.place, still);
}

void ComparisonTool::sayPlace(const StationInterval& place)
{
    view_->sayPlace(tr("Same place: %1 mm, %2 to %3 (80 %)")
                        .arg(place.station_mm, 0, 'f', 0)
                        .arg(place.least_mm, 0, 'f', 0)
                        .arg(place.most_mm, 0, 'f', 0),
                    tr("From the %1; it lies in between with a probability of 80 %. Found by %2.")
                        .arg(reading_.organWords().first_end.c_str(), nameOf(map_->source).c_str()));
}

void ComparisonTool::markerShown(const Marker& marker)
{
    partner_markers_.clear();
    for (const std::string& id : marker.partners)
        if (const auto partner = reading_.session().marker(id))
            partner_markers_.push_back(*partner);
    showPartner();
}

void ComparisonTool::pointLeft()
{
    partner_markers_.clear();
    partner_.reset();
}

void ComparisonTool::showPartner()
{
    const OpenScan* scan = reading_.session().beside();
    partner_.reset();
    for (const Marker& marker : partner_markers_)
        if (scan && marker.scan_id == scan->record.id)
            partner_ = Partner{viewOfMarker(*scan, marker), marker.position_mm};
}

}  // namespace vicon::viewer
