#include "reading/reading.h"

#include <algorithm>

#include "widgets/kept_settings.h"

namespace vicon::viewer {
namespace {

constexpr int kStill_ms = 150;        // after the last movement the picture is drawn smoothly
constexpr double kFromLumen_mm = 15;  // a click on a slice this near to the lumen moves the eye as well

}  // namespace

Reading::Reading(const ReadingServices& services, const WorklistCase& row, ReadingViews& views, QObject* parent)
    : QObject(parent), views_(views), session_(services, row, this), drawing_(this), still_(kStill_ms, [this] {
          drawEndoscopic(true);
          for (ReadingTool* tool : tools_)
              tool->draw(true);
      })
{
}

void Reading::setTools(std::vector<ReadingTool*> tools)
{
    tools_ = std::move(tools);
    connectSession();
    connectViews();
}

void Reading::connectSession()
{
    connect(&session_, &CaseSession::markersChanged, this, &Reading::markersChanged);
    connect(&session_, &CaseSession::saved, this, &Reading::said);
    connect(&session_, &CaseSession::warned, this, &Reading::warned);
    connect(&drawing_, &DrawingThread::failed, this, [this](const QString& message) {
        shown_ = {};  // a flight without pictures does not wait for one
        warn(message);
    });
    connect(&drawing_, &DrawingThread::withoutOpenGl, this, [this] {
        warn(
            tr("OpenGL does not work here (its driver in Debian: libgl1-mesa-dri). The view from inside is cast "
               "through the densities: slower, and what it shows does not count as reviewed."));
    });
    connect(&drawing_, &DrawingThread::endoscopicDrawn, this, &Reading::showEndoscopic);
    connect(&drawing_, &DrawingThread::wallShaded, this, [this] { moved(true); });
    connect(&drawing_, &DrawingThread::overviewDrawn, this,
            [this](const Picture& picture, const ShownProjection& shown) {
                if (!shown.isOf(sharedScan()) || overview_turned_)
                    return;
                shown_overview_ = shown;
                views_.overview()->showPicture(picture);
                sayWhereOverviewIs();
                emit overviewShown();
            });
}

void Reading::connectViews()
{
    connect(views_.endoscopic(), &PictureView::resized, this, [this] { drawEndoscopic(true); });
    connect(views_.endoscopic(), &PictureView::clicked, this, &Reading::clickedEndoscopic);
    takeBackClicksIn(views_.endoscopic());
    connect(views_.overview(), &PictureView::resized, this, [this] { drawOverview(true); });
    takeBackClicksIn(views_.overview());
    for (SliceView* slice : views_.slices()) {
        connect(slice, &SliceView::pointClicked, this, [this, slice](Point3 point, Qt::KeyboardModifiers modifiers) {
            clickedSlice(*slice, point, modifiers);
        });
        takeBackClicksIn(slice);
        connect(slice, &SliceView::failed, this, &Reading::warned);
        connect(slice, &SliceView::trackWanted, this, &Reading::trackWanted);
        connect(slice, &SliceView::windowDragged, this, &Reading::windowDragged);
    }
    connect(&views_, &ReadingViews::sizesLeft, this,
            [this](const QVariantMap& sizes) { keepSettings(settings_worker_, sizes); });
}

void Reading::showEndoscopic(const Picture& picture, const ShownPicture& shown)
{
    if (!shown.isOf(sharedScan()))
        return;  // another scan is read by now: no two views show different ones
    shown_ = shown;
    views_.endoscopic()->showPicture(picture);
    sayWhatIsDrawn();
    views_.endoscopic()->setProperty("shaded", shown.shaded);
    views_.endoscopic()->setAccessibleDescription(
        organWords().has_path
            ? tr("%1 mm from the %2").arg(shown.place.station_mm, 0, 'f', 0).arg(organWords().first_end.c_str())
            : tr("%1 mm from the wall").arg(shown.place.clearance_mm, 0, 'f', 0));
    emit endoscopicShown();
}

SnapshotResult Reading::place() const
{
    const NavigationState state = navigator()->state();
    return {state.pose, state.station_mm, state.clearance_mm, true};
}

void Reading::moved(bool still)
{
    if (!navigator())
        return;
    drawEndoscopic(still);
    for (ReadingTool* tool : tools_)
        tool->draw(still);
    if (!still)
        still_.start();
    drawOverview(still);
    showPlace();
}

void Reading::flewOn()
{
    looked_at_mm_.reset();
    for (ReadingTool* tool : tools_)
        tool->pointLeft();
    moved(false);
}

void Reading::goTo(const ViewPose& view, Point3 looked_at_mm)
{
    if (!navigator())
        return;
    beginPass();
    navigator()->lookFrom(view.pose, view.station_mm);
    looked_at_mm_ = looked_at_mm;
    moved(true);
}

void Reading::goTo(Point3 point)
{
    if (!navigator())
        return;
    if (scan()->lumen.nearestInside(point, kFromLumen_mm).found) {
        goTo(poseForPoint(scan()->files.skeleton(), scan()->files.frames(), scan()->lumen, point), point);
        return;
    }
    looked_at_mm_ = point;
    moved(true);
}

void Reading::lookFrom(const ViewPose& view, Point3 looked_at_mm)
{
    goTo(view, looked_at_mm);
    centreSlices();
}

void Reading::lookAt(Point3 point)
{
    goTo(point);
    centreSlices();
}

void Reading::centreSlices()
{
    for (SliceView* slice : views_.slices())
        slice->centreOnPoint();
}

void Reading::showMarker(const Marker& marker)
{
    if (!navigator())
        return;
    if (marker.scan_id != scan()->record.id) {
        ScanRequest request;
        request.scan_id = marker.scan_id;
        request.marker_id = marker.id;
        changeScan(request);
        return;
    }
    for (ReadingTool* tool : tools_)
        tool->markerShown(marker);
    lookFrom(viewOfMarker(*scan(), marker), marker.position_mm);
}

void Reading::beginPass()
{
    for (OpenScan* open : {session_.scan(), session_.beside()})
        if (open)
            open->coverage.beginPass();
}

std::optional<Marker> Reading::markerNear(const std::string& scan_id,
                                          const std::function<double(Point3)>& away_mm) const
{
    std::optional<Marker> nearest;
    double least = kMeasureNear_mm;
    for (const Marker& marker : session_.markersOf(scan_id))
        if (const double d = away_mm(marker.position_mm); d < least || (!nearest && d == least)) {
            least = d;
            nearest = marker;
        }
    return nearest;
}

void Reading::setLine(const std::optional<MeasuredLine>& line)
{
    line_ = line;
    emit lineChanged();
}

void Reading::markersChanged()
{
    const auto tool_before = interaction_.tool().index();
    interaction_.markersChanged(session_.markers());
    if (interaction_.tool().index() != tool_before)
        toolChanged();
    for (ReadingTool* tool : tools_)
        tool->markersChanged();
    emit historyChanged();
    moved(true);
}

void Reading::changeScan(const ScanRequest& request)
{
    for (ReadingTool* tool : tools_)
        tool->scanLeft();
    keep();
    emit scanWanted(request);
}

void Reading::arrive(const Arrival& arrival)
{
    drawing_.scanChanged();
    views_.endoscopic()->setAccessibleDescription({});  // its picture is still to come
    clearPictures();
    before_click_.reset();
    interaction_.scanChanged();
    looked_at_mm_.reset();
    warn({});
    useWords(organWords());
    for (ReadingTool* tool : tools_)
        tool->scanOpened(arrival);
    rememberFound();
    if (const auto marker = session_.marker(arrival.marker_id.value_or("")))
        showMarker(*marker);
    markersChanged();
}

void Reading::clearPictures()
{
    shown_ = {};
    shown_overview_.reset();
    const QString words = tr("%1: this picture is still to come").arg(QString::fromStdString(scan()->caption.position));
    views_.endoscopic()->setProperty("shaded", false);
    views_.endoscopic()->clearPicture(words);
    views_.overview()->clearPicture(words);
    for (SliceView* slice : views_.slices())
        slice->leave(words);
}

void Reading::stay()
{
    for (ReadingTool* tool : tools_)
        tool->scanStays();
}

void Reading::useWords(const OrganWords& words)
{
    views_.overview()->setAccessibleName(tr("Projection of the %1").arg(QString::fromStdString(words.organ.name())));
    for (ReadingTool* tool : tools_)
        tool->useWords(words);
}

bool Reading::redoesScan() const
{
    return std::any_of(tools_.begin(), tools_.end(), [](const ReadingTool* tool) { return tool->redoesScan(); });
}

void Reading::stop()
{
    still_.stop();
    for (ReadingTool* tool : tools_) {
        tool->scanLeft();
        tool->stop();
    }
    drawing_.end();
}

}  // namespace vicon::viewer
