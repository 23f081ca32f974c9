#include "flight/flight_tool.h"

#include <QAction>
#include <algorithm>
#include <cmath>
#include <utility>

#include "flight/navigation_panel.h"
#include "reading/kept_place.h"
#include "reading/reading.h"
#include "widgets/kept_settings.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
namespace {
constexpr int kFrame_ms = 16;
constexpr double kNarrowest_deg = 60, kWidest_deg = 120;
constexpr const char* kMode = "mode";
}  // namespace

FlightTool::FlightTool(Reading& reading) : ReadingTool(reading), panel_(new NavigationPanel)
{
    timer_.setTimerType(Qt::PreciseTimer);
    timer_.setInterval(kFrame_ms);
    connect(&timer_, &QTimer::timeout, this, &FlightTool::tick);
}

void FlightTool::addTo(ReadingLayout& layout)
{
    layout_ = &layout;
    layout.addPanel(panel_, ReadingLayout::PanelPlace::above_lists);
    addActions(layout);
    connectPanel();
    connectViews();
}

Navigator* FlightTool::navigator() const
{
    return reading_.navigator();
}

void FlightTool::restore()
{
    setAngle(keptSetting(readerKey("angle_deg"), view_angle_deg_).toDouble());
}

QVariantMap FlightTool::kept() const
{
    const CaseRecord& record = reading_.session().record();
    QVariantMap values{{readerKey("angle_deg"), view_angle_deg_}};
    if (!navigator())
        return values;
    values[keptKey(record, "to_rectum")] = navigator()->heading() == Heading::rectum;
    values[readerKey("speed_mm_s")] = navigator()->speed_mm_s();
    if (navigator()->hasPath())  // without one there is one kind of flight, and nobody chose it
        values[readerKey(kMode)] = int(navigator()->mode());
    values[keptKey(record, QString::fromStdString(reading_.scan()->record.id))] = navigator()->state().station_mm;
    return values;
}

void FlightTool::useWords(const OrganWords& words)
{
    to_first_end_->setText(tr("Jump to the %1").arg(QString::fromStdString(words.first_end)));
    to_last_end_->setText(tr("Jump to the %1").arg(QString::fromStdString(words.last_end)));
}

void FlightTool::scanLeft()
{
    left_ = reading_.sharedScan();
}

void FlightTool::scanOpened(const Arrival& arrival)
{
    if (const auto left = std::exchange(left_, {}))
        takePlace(arrival, *left);
    else
        takeKeptPlace();
    clock_.start();
    timer_.start();
}

void FlightTool::takePlace(const Arrival& arrival, const OpenScan& left)
{
    const OpenScan& scan = *reading_.scan();
    navigator()->setHeading(left.navigator.heading());
    navigator()->setSpeed(left.navigator.speed_mm_s());
    if (left.navigator.hasPath())
        navigator()->setMode(left.navigator.mode());
    if (!haveSamePlaces(left, scan)) {
        if (std::holds_alternative<SamePlace>(arrival.place))
            navigator()->lookFrom(left.navigator.state().pose, 0);
        else
            takeKeptPlace();
        return;
    }
    if (const auto* other = std::get_if<CorrespondingPlace>(&arrival.place))
        comeTo(reading_.session().mapBetween(left, scan).at(other->station_mm).station_mm);
    else if (const auto* same = std::get_if<SamePlace>(&arrival.place))
        comeTo(scan.files.skeleton().nearest(same->point_mm.value_or(left.navigator.state().pose.eye_mm)).station_mm);
}

void FlightTool::takeKeptPlace()
{
    const auto kept = [this](const QString& name, const QVariant& otherwise = {}) {
        return keptSetting(keptKey(reading_.session().record(), name), otherwise);
    };
    navigator()->setHeading(kept("to_rectum").toBool() ? Heading::rectum : Heading::caecum);
    navigator()->setSpeed(keptSetting(readerKey("speed_mm_s"), navigator()->speed_mm_s()).toDouble());
    const int mode = keptSetting(readerKey(kMode), kept(kMode)).toInt();  // once it was kept with the case
    if (mode >= int(NavigationMode::planned) && mode <= int(NavigationMode::free))
        navigator()->setMode(NavigationMode(mode));
    comeTo(kept(QString::fromStdString(reading_.scan()->record.id), 0).toDouble());
}

void FlightTool::comeTo(double station_mm)
{
    constexpr double kOff_mm = 5;
    navigator()->jumpTo(station_mm);
    if (std::abs(navigator()->state().station_mm - station_mm) <= kOff_mm)
        return;
    navigator()->setMode(NavigationMode::planned);
    navigator()->jumpTo(station_mm);
}

void FlightTool::placeShown()
{
    panel_->show(*navigator(), reading_.scan()->files.frames().length_mm(), reading_.organWords());
    layout_->notice(noticeHere());
}

QString FlightTool::noticeHere() const
{
    const NavigationState state = navigator()->state();
    constexpr double kAtWall_mm = 3;  // nearer, the picture shows one even patch of wall
    if (state.carried)
        return tr("collapsed segment: carried along the centreline");
    if (navigator()->mode() == NavigationMode::free && state.clearance_mm < kAtWall_mm)
        return navigator()->hasPath() ? tr("free, close to the wall: S backs off, P goes back to the centreline")
                                      : tr("free, close to the wall: let go, and it pushes back");
    return {};
}

void FlightTool::escape()
{
    panel_->forgetStation();
}

void FlightTool::style(EndoscopicRequest& request) const
{
    request.snapshot.view_angle_deg = view_angle_deg_;
}

void FlightTool::tick()
{
    const double seconds = double(clock_.nsecsElapsed()) * 1e-9;
    clock_.restart();
    constexpr double kMost_s = 0.25;  // after a pause of the whole machine the flight does not leap
    const Pose before = navigator()->state().pose;
    if (waitsForPicture() || isHeld())
        return;
    navigator()->advance(std::min(seconds, kMost_s));
    const NavigationState now = navigator()->state();
    if (now.at_end && navigator()->direction() > 0)
        navigator()->fly(0);
    if (!(now.pose.eye_mm == before.eye_mm) || !(now.pose.forward == before.forward))
        reading_.flewOn();
}

// No view moves by itself while a finding is measured in it.
bool FlightTool::isHeld() const
{
    return reading_.interaction().measures() && !navigator()->isDriven();
}

// On a machine that draws slowly the flight is slower; wall that flies past unshown would be wall unread.
bool FlightTool::waitsForPicture() const
{
    constexpr double kMostAhead_mm = 20;        // of the eye before the picture; 0.2 s of the fastest flight
    constexpr double kMostAheadOfSlice_mm = 4;  // a polyp of 6 mm is in one of the pictures
    if (const SliceView* slice = reading_.views().firstSlice();
        slice && slice->isBehind(reading_.sharedScan(), navigator()->state(), kMostAheadOfSlice_mm))
        return true;
    const ShownPicture& shown = reading_.shown();
    return shown.isOf(reading_.sharedScan()) && reading_.views().endoscopic()->isVisible() &&
           distance(shown.place.pose.eye_mm, navigator()->state().pose.eye_mm) > kMostAhead_mm;
}

bool FlightTool::hasPath()
{
    if (navigator()->hasPath())
        return true;
    reading_.say(tr("The %1 has no centreline: it is flown freely; Home shows it from its middle.")
                     .arg(QString::fromStdString(reading_.organWords().organ.name())));
    return false;
}

void FlightTool::setMode(NavigationMode mode)
{
    if (!navigator() || (mode != NavigationMode::free && !hasPath()))
        return;
    navigator()->setMode(mode);
    steer();
    reading_.moved(true);
}

void FlightTool::fly(int direction)
{
    if (!navigator() || !hasPath())
        return;
    if (direction != 0 && navigator()->mode() == NavigationMode::free)
        navigator()->setMode(NavigationMode::planned);  // on along the path from where the eye is
    if (direction > 0 && navigator()->mode() == NavigationMode::planned && navigator()->state().at_end) {
        const OrganWords& words = reading_.organWords();
        const std::string& end = navigator()->heading() == Heading::caecum ? words.last_end : words.first_end;
        reading_.say(tr("This is the %1, where the flight ends; R reverses it.").arg(QString::fromStdString(end)));
        return;
    }
    navigator()->fly(direction);
    reading_.moved(false);
}

void FlightTool::turnAbout()
{
    if (!navigator() || !hasPath())
        return;
    reading_.beginPass();
    navigator()->setHeading(navigator()->heading() == Heading::caecum ? Heading::rectum : Heading::caecum);
    reading_.moved(true);
}

void FlightTool::goToEnd(Heading end)
{
    if (!navigator())
        return;
    navigator()->setHeading(end == Heading::caecum ? Heading::rectum : Heading::caecum);
    navigator()->setLookBack(false);
    jumpTo(end == Heading::caecum ? reading_.scan()->files.frames().length_mm() : 0);
}

void FlightTool::jumpTo(double station_mm)
{
    reading_.views().first()->setFocus();
    if (!navigator())
        return;
    navigator()->jumpTo(station_mm);
    reading_.flewOn();
    reading_.beginPass();
    constexpr double kOff_mm = 5;
    if (navigator()->mode() == NavigationMode::guided &&
        std::abs(navigator()->state().station_mm - station_mm) > kOff_mm)
        reading_.say(tr("There it is too narrow for the guided flight; the planned one (P) reaches it."));
}

void FlightTool::lookBack(bool on)
{
    if (!navigator() || !hasPath())
        return;
    if (on && navigator()->mode() != NavigationMode::planned) {
        navigator()->setMode(NavigationMode::planned);
        reading_.say(tr("Planned flight, looking back"));
    }
    navigator()->setLookBack(on);
    reading_.flewOn();
    reading_.beginPass();
}

void FlightTool::step(double mm)
{
    if (!navigator())
        return;
    navigator()->step(mm);
    reading_.flewOn();
}

void FlightTool::setSpeed(double mm_s)
{
    if (!navigator())
        return;
    navigator()->setSpeed(mm_s);
    reading_.flewOn();
}

void FlightTool::setAngle(double angle_deg)
{
    view_angle_deg_ = std::clamp(angle_deg, kNarrowest_deg, kWidest_deg);
    panel_->setAngle(view_angle_deg_);
    if (reading_.scan())
        reading_.moved(true);
}

void FlightTool::steer()
{
    if (navigator())
        navigator()->steer(keys_.steering(navigator()->mode()));
}

}  // namespace vicon::viewer
