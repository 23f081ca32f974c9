#include "reading_window.h"

#include <QAction>
#include <QCloseEvent>
#include <QComboBox>
#include <QKeyEvent>
#include <QLabel>
#include <QStatusBar>
#include <algorithm>
#include <utility>

#include "control_keys.h"
#include "kept_settings.h"
#include "second_window.h"
#include "vicon/cases/printed.h"
#include "vicon/viewer/model/annotate.h"
#include "vicon/viewer/model/window_level.h"

namespace vicon::viewer {
namespace {
constexpr int kFrame_ms = 16;
constexpr int kStill_ms = 150;  // after the last movement the picture is drawn smoothly
constexpr int kPoll_ms = 2000;  // how often other readers' changes are looked for
}  // namespace

ReadingWindow::ReadingWindow(const ReadingServices& services, const WorklistCase& row)
    : session_(services, row), corrector_(services, row.record.id)
{
    setObjectName("reading");
    setWindowTitle(tr("%1 - VICON").arg(QString::fromStdString(patientName(row.record.patient.name))));
    buildViews();
    addActions();
    useWords(wordsFor("colon"));  // until a scan is open
    connectAll();
    new ControlKeys(this, endoscopic_);
    orderTabs();
    restoreLooks();
    if (session_.scans().empty())
        warn(tr("No scan of this case can be read yet; the first one opens as soon as it can."));
    else
        openFirst(session_.scans());
}

ReadingWindow::~ReadingWindow() = default;

void ReadingWindow::connectAll()
{
    connect(&session_, &CaseSession::opened, this, &ReadingWindow::scanOpened);
    connect(&session_, &CaseSession::markersChanged, this, &ReadingWindow::markersChanged);
    // A second change of a marker before the first is saved would start from what it was.
    connect(&session_, &CaseSession::busyChanged, table_, &MarkerTable::setBusy);
    connect(&session_, &CaseSession::saved, this, &ReadingWindow::tell);
    connect(&session_, &CaseSession::warned, this, &ReadingWindow::warn);
    connect(&session_, &CaseSession::measured, this, &ReadingWindow::showMeasured);
    connect(&session_, &CaseSession::reportWritten, this,
            [this](const QString& file) { tell(tr("Report written: %1").arg(file)); });
    connect(&studio_, &Studio::failed, this, [this](const QString& message) {
        shown_ = {};  // a flight without pictures does not wait for one
        warn(message);
    });
    connect(&studio_, &Studio::withoutOpenGl, this, [this] {
        warn(
            tr("OpenGL does not work here (its driver in Debian: libgl1-mesa-dri). The view from inside is cast "
               "through the densities: slower, and what it shows is not counted as seen."));
    });
    connect(&studio_, &Studio::endoscopicDrawn, this, [this](const Picture& picture, const Studio::Shown& shown) {
        shown_ = shown;
        endoscopic_->showPicture(picture);
        if (shown.isOf(session_.sharedScan()))
            endoscopic_->setAccessibleDescription(
                tr("%1 mm from the %2").arg(shown.place.station_mm, 0, 'f', 0).arg(organWords().first_end.c_str()));
        drawMeasured();
    });
    connect(&studio_, &Studio::overviewDrawn, this, [this](const Picture& picture, const PlaneView& view) {
        shown_overview_ = view;
        overview_shown_ = true;
        overview_->showPicture(picture);
    });
    connect(endoscopic_, &PictureView::resized, this, [this] { drawEndoscopic(true); });
    connect(endoscopic_, &PictureView::clicked, this, &ReadingWindow::clickedEndoscopic);
    connect(endoscopic_, &PictureView::hovered, this, [this](Pixel at) {
        lens_at_ = at;
        if (peeling_->on() && peeling_->circleOnly()) {
            drawEndoscopic(false);
            still_.start();
        }
    });
    connect(endoscopic_, &PictureView::enlargeWanted, this, [this] { enlarge(endoscopic_); });
    connect(endoscopic_, &PictureView::turned, this, [this](int steps) { emit navigation_->stepWanted(5.0 * steps); });
    connect(endoscopic_, &PictureView::dragged, this, [this](QPointF by) {
        if (navigator() && navigator()->mode() == NavigationMode::planned)
            setMode(NavigationMode::guided);
        const double full = endoscopic_->pictureSize().height() / 4.0;  // a drag this long steers fully
        mouse_steering_ += QPointF(by.x() / full, -by.y() / full);
        updateSteering();
    });
    connect(endoscopic_, &PictureView::dragEnded, this, [this] {
        mouse_steering_ = {};
        updateSteering();
    });
    connect(overview_, &PictureView::resized, this, &ReadingWindow::drawOverview);
    connect(overview_, &PictureView::clicked, this, &ReadingWindow::clickedOverview);
    for (SliceView* slice : {transverse_, coronal_, sagittal_}) {
        connect(slice, &SliceView::pointClicked, this, &ReadingWindow::clickedSlice);
        connect(slice, &SliceView::failed, this, &ReadingWindow::warn);
        connect(slice, &PictureView::enlargeWanted, this, [this, slice] { enlarge(slice); });
        connect(window_choice_, &QComboBox::currentTextChanged, slice,
                [slice](const QString& name) { slice->setWindow(windowPreset(name.toStdString())); });
    }
    connect(scan_choice_, qOverload<int>(&QComboBox::activated), this, [this](int) {
        ScanRequest request;
        request.scan_id = scan_choice_->currentData().toString().toStdString();
        changeScan(request);
    });
    connect(way_choice_, qOverload<int>(&QComboBox::activated), this,
            [this] { takeWay(way_choice_->currentData().toInt(), {}); });
    showPictureTip();
    connect(peeling_, &PeelingPanel::changed, this, [this] {
        showPictureTip();
        drawEndoscopic(false);
        still_.start();
    });

    connect(table_, &MarkerTable::flyWanted, this, &ReadingWindow::flyTo);
    connect(table_, &MarkerTable::changed, this,
            [this](const Marker& before, const Marker& after) { session_.changeMarker(before, after, false); });
    connect(table_, &MarkerTable::removeWanted, &session_, &CaseSession::removeMarker);
    connect(table_, &MarkerTable::pairWanted, this, &ReadingWindow::pair);
    connect(table_, &MarkerTable::moveWanted, this, &ReadingWindow::startMoving);
    connect(table_, &MarkerTable::undoWanted, this, &ReadingWindow::undo);
    connect(table_, &MarkerTable::redoWanted, this, &ReadingWindow::redo);

    const auto steered = [this](auto what) {
        return [this, what](auto value) {
            if (!navigator())
                return;
            focus_.reset();
            beside_place_.reset();
            (navigator()->*what)(value);
            moved(false);
        };
    };
    connect(navigation_, &NavigationPanel::modeWanted, this, &ReadingWindow::setMode);
    connect(navigation_, &NavigationPanel::flyWanted, this, &ReadingWindow::fly);
    connect(navigation_, &NavigationPanel::turnAboutWanted, this, &ReadingWindow::turnAbout);
    connect(navigation_, &NavigationPanel::lookBackWanted, this, steered(&Navigator::setLookBack));
    connect(navigation_, &NavigationPanel::speedWanted, this, steered(&Navigator::setSpeed));
    connect(navigation_, &NavigationPanel::stepWanted, this, steered(&Navigator::step));
    connect(navigation_, &NavigationPanel::jumpWanted, this, steered(&Navigator::jumpTo));
    connect(navigation_, &NavigationPanel::jumpWanted, this, &ReadingWindow::sayWhereItIsNarrow);
    connect(navigation_, &NavigationPanel::jumpWanted, endoscopic_, [this] { endoscopic_->setFocus(); });

    connectCoverage();
    connectBeside();
    connectBiopsy();
    connectCorrections();
    connectFilm();
    connectOpening();
    timer_.setTimerType(Qt::PreciseTimer);
    timer_.setInterval(kFrame_ms);
    connect(&timer_, &QTimer::timeout, this, &ReadingWindow::tick);
    still_.setSingleShot(true);
    still_.setInterval(kStill_ms);
    connect(&still_, &QTimer::timeout, this, [this] {
        drawEndoscopic(true);
        drawBeside(true);
    });
    poll_.setInterval(kPoll_ms);
    connect(&poll_, &QTimer::timeout, &session_, &CaseSession::refresh);
    poll_.start();
}

void ReadingWindow::tick()
{
    const double seconds = double(clock_.nsecsElapsed()) * 1e-9;
    clock_.restart();
    constexpr double kMost_s = 0.25;  // after a pause of the whole machine the flight does not leap
    const Pose before = navigator()->state().pose;
    if (waitsForPicture())
        return;
    navigator()->advance(std::min(seconds, kMost_s));
    const NavigationState now = navigator()->state();
    if (now.at_end && navigator()->direction() > 0)
        navigator()->fly(0);
    if (!(now.pose.eye_mm == before.eye_mm) || !(now.pose.forward == before.forward)) {
        focus_.reset();
        beside_place_.reset();
        moved(false);
    }
}

// On a machine that draws slowly the flight is slower; wall that flies past unshown would be wall unread.
bool ReadingWindow::waitsForPicture() const
{
    constexpr double kMostAhead_mm = 20;  // of the eye before the picture; 0.2 s of the fastest flight
    return shown_.isOf(session_.sharedScan()) && endoscopic_->isVisible() &&
           distance(shown_.place.pose.eye_mm, navigator()->state().pose.eye_mm) > kMostAhead_mm;
}

void ReadingWindow::moved(bool still)
{
    if (!navigator())
        return;
    drawEndoscopic(still);
    drawBeside(still);
    if (!still)
        still_.start();
    drawOverview();
    showPlace();
}

SnapshotRequest ReadingWindow::request(const OpenScan& scan, const QSize& size) const
{
    SnapshotRequest request;
    request.width = size.width();
    request.height = size.height();
    request.pixel_ratio = devicePixelRatioF();
    request.view_angle_deg = view_angle_deg_;
    request.caption = scan.caption;
    request.markers = session_.markersOf(scan.record.id);
    return request;
}

SnapshotResult ReadingWindow::place() const
{
    const NavigationState state = navigator()->state();
    return {state.pose, state.station_mm, state.clearance_mm, true};
}

void ReadingWindow::drawEndoscopic(bool still)
{
    if (!session_.scan())
        return;
    Studio::Wish wish = wishFor(*session_.scan(), navigator()->state(), endoscopic_->pictureSize(), still);
    wish.count_seen = endoscopic_->isVisible();
    peeling_->fill(wish.request);
    wish.request.peel_circle_at = lens_at_;
    fillCircle(wish.request, wish.place.pose);
    studio_.drawEndoscopic(session_.sharedScan(), wish);
}

void ReadingWindow::drawOverview()
{
    if (session_.scan())
        studio_.drawOverview(session_.sharedScan(), request(*session_.scan(), overview_->pictureSize()), place());
}

void ReadingWindow::showPlace()
{
    const NavigationState state = navigator()->state();
    navigation_->show(*navigator(), session_.scan()->files.frames().length_mm(), organWords());
    notice_->setText(state.carried ? tr("collapsed or narrow part: carried along the path") : QString());
    const auto markers = session_.markersOf(session_.scan()->record.id);
    for (SliceView* slice : {transverse_, coronal_, sagittal_})
        slice->look(session_.sharedScan(), focus_.value_or(state.pose.eye_mm), state.pose, markers);
}

void ReadingWindow::markersChanged()
{
    std::map<std::string, std::string> positions;
    for (const ScanRecord& scan : session_.scans())
        positions[scan.id] = positionName(scan.series.patient_position);
    table_->show(session_.markers(), positions);
    const auto tool_before = interaction_.tool().index();
    interaction_.markersChanged(session_.markers());
    if (interaction_.tool().index() != tool_before)
        showTool();
    showHistory();
    moved(true);
}

void ReadingWindow::showHistory()
{
    table_->setUndo(session_.toUndo() || corrector_.toUndo(), session_.toRedo() || corrector_.toRedo());
}

// Markers and corrections have histories of their own; what was done last of both goes first.
void ReadingWindow::undo()
{
    if (corrector_.toUndo() && !table_->isEnabled())
        return;  // a marker's step is on its way: which of the two was last is not known yet
    if (undoneBefore(corrector_.toUndo(), session_.toUndo()))
        corrector_.undo();
    else
        session_.undo();
}

void ReadingWindow::redo()
{
    if (redoneBefore(corrector_.toRedo(), session_.toRedo()))
        corrector_.redo();
    else
        session_.redo();
}

void ReadingWindow::tell(const QString& message)
{
    statusBar()->showMessage(message);
}

void ReadingWindow::warn(const QString& message)
{
    tell({});
    warning_->setText(message);
    warning_->setToolTip(message);
}

void ReadingWindow::keyPressEvent(QKeyEvent* event)
{
    if (event->isAutoRepeat())
        return;
    keys_.insert(event->key());
    updateSteering();
}

void ReadingWindow::keyReleaseEvent(QKeyEvent* event)
{
    if (event->isAutoRepeat())
        return;
    keys_.erase(event->key());
    updateSteering();
}

void ReadingWindow::changeEvent(QEvent* event)
{
    if (event->type() == QEvent::ActivationChange && !isActiveWindow()) {
        keys_.clear();  // a key that is let go elsewhere would steer for ever
        updateSteering();
    }
    QMainWindow::changeEvent(event);
}

void ReadingWindow::closeEvent(QCloseEvent* event)
{
    timer_.stop();
    savePlace();
    saveLooks();
    if (second_)
        second_->hide();
    keepSeen();
    poll_.stop();
    keep_seen_.stop();
    still_.stop();
    end();
    event->accept();
}

// What is being drawn, read or saved is waited for without a window that does not answer.
void ReadingWindow::end()
{
    constexpr int kLook_ms = 20;
    corrector_.stop();
    studio_.end();
    for (QObject* part : std::initializer_list<QObject*>{&session_, &studio_, &seen_keeper_, &corrector_, this})
        for (Worker* worker : part->findChildren<Worker*>()) {
            worker->end();
            workers_.push_back(worker);
        }
    auto* look = new QTimer(this);
    connect(look, &QTimer::timeout, this, [this] {
        if (std::all_of(workers_.begin(), workers_.end(), [](const Worker* worker) { return worker->ended(); }))
            deleteLater();
    });
    look->start(kLook_ms);
    emit closed();
}

}  // namespace vicon::viewer
