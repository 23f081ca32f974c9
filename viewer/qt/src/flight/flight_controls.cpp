// What the controls, the keys and the mouse do to the flight.
#include <QAction>
#include <QKeyEvent>
#include <cmath>

#include "flight/flight_tool.h"
#include "flight/navigation_panel.h"
#include "reading/reading.h"
#include "vicon/viewer/model/home_place.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
namespace {
constexpr double kStep_mm = 10, kWheelStep_mm = 5, kFaster_mm_s = 5;
}

void FlightTool::addActions(ReadingLayout& layout)
{
    const auto add = [&layout](const QString& title, const char* key, std::function<void()> what) {
        return layout.addAction(ReadingMenu::flight, title, QKeySequence(key), std::move(what));
    };
    add(tr("Planned"), "P", [this] { setMode(NavigationMode::planned); });
    add(tr("Guided"), "G", [this] { setMode(NavigationMode::guided); });
    add(tr("Free"), "F", [this] { setMode(NavigationMode::free); });
    add(tr("Fly or stop"), "Space", [this] { fly(navigator() && navigator()->direction() ? 0 : 1); });
    add(tr("Reverse the flight"), "R", [this] { turnAbout(); });
    add(tr("Look back"), "B", [this] {
        lookBack(navigator() && !(navigator()->looksBack() && navigator()->mode() == NavigationMode::planned));
    });
    add(tr("A centimetre on"), ".", [this] { step(kStep_mm); });
    add(tr("A centimetre back"), ",", [this] { step(-kStep_mm); });
    add(tr("Jump to a distance"), "J", [this] {
        if (!navigator() || hasPath())
            panel_->askStation();
    });
    to_first_end_ = add({}, "Home", [this] { goToEnd(Heading::rectum); });
    to_last_end_ = add({}, "End", [this] { goToEnd(Heading::caecum); });
    const auto faster = [this](double by_mm_s) {
        if (navigator())
            setSpeed(navigator()->speed_mm_s() + by_mm_s);
    };
    add(tr("Faster"), "+", [faster] { faster(kFaster_mm_s); });
    add(tr("Slower"), "-", [faster] { faster(-kFaster_mm_s); });
}

void FlightTool::connectPanel()
{
    connect(panel_, &NavigationPanel::modeWanted, this, &FlightTool::setMode);
    connect(panel_, &NavigationPanel::flyWanted, this, &FlightTool::fly);
    connect(panel_, &NavigationPanel::turnAboutWanted, this, &FlightTool::turnAbout);
    connect(panel_, &NavigationPanel::lookBackWanted, this, &FlightTool::lookBack);
    connect(panel_, &NavigationPanel::speedWanted, this, &FlightTool::setSpeed);
    connect(panel_, &NavigationPanel::stepWanted, this, &FlightTool::step);
    connect(panel_, &NavigationPanel::jumpWanted, this, &FlightTool::jumpTo);
    connect(panel_, &NavigationPanel::angleWanted, this, &FlightTool::setAngle);
    connect(&reading_, &Reading::jumpWanted, this, &FlightTool::jumpTo);
    connect(&reading_, &Reading::stepWanted, this, [this](int steps) { step(kWheelStep_mm * steps); });
}

void FlightTool::connectViews()
{
    ReadingViews& views = reading_.views();
    PictureView* endoscopic = views.endoscopic();
    connect(endoscopic, &PictureView::turned, this, [this](int steps) { step(kWheelStep_mm * steps); });
    connect(endoscopic, &PictureView::dragged, this, [this, endoscopic](QPointF by) {
        if (navigator() && navigator()->mode() == NavigationMode::planned)
            setMode(NavigationMode::guided);
        const double full = endoscopic->pictureSize().height() / 4.0;  // a drag this long steers fully
        keys_.drag({by.x() / full, -by.y() / full});
        steer();
    });
    connect(endoscopic, &PictureView::dragEnded, this, [this] {
        keys_.endDrag();
        steer();
    });
    connect(views.overview(), &PictureView::clicked, this, &FlightTool::clickedOverview);
    connect(&views, &ReadingViews::keyPressed, this, [this](const QKeyEvent* event) {
        if (event->isAutoRepeat())
            return;
        keys_.press(event->key());
        steer();
    });
    connect(&views, &ReadingViews::keyReleased, this, [this](const QKeyEvent* event) {
        if (event->isAutoRepeat())
            return;
        keys_.release(event->key());
        steer();
    });
    connect(&views, &ReadingViews::keyboardLeft, this, [this] {
        keys_.releaseAll();  // a key that is let go elsewhere would steer for ever
        steer();
    });
}

/// To the place of the way that is nearest in the picture. Where the organ branches, another tool chooses the way.
void FlightTool::clickedOverview(Pixel at, Qt::KeyboardModifiers modifiers)
{
    if (!navigator() || !reading_.shownOverview() || !reading_.scan()->files.tree().empty())
        return;
    if (reading_.interaction().inUse<Measure>()) {
        reading_.warn(tr("The projection has no depth: measure on the wall or in a slice."));
        return;
    }
    if (!navigator()->hasPath()) {
        clickedCavity(at, modifiers);
        return;
    }
    const PathFrames& path = reading_.scan()->files.frames();
    double station = 0, least = 1e300;
    for (double s = 0; s <= path.length_mm(); s += 1) {
        const Pixel p = reading_.shownOverview()->toPixel(path.at(s).position_mm);
        if (const double d = std::hypot(p.x - at.x, p.y - at.y); d < least) {
            least = d;
            station = s;
        }
    }
    if (!reading_.click({*reading_.scan(), {}, path.at(station).position_mm, modifiers, false}))
        jumpTo(station);
}

/// To the place farthest from the wall behind that of the picture, looking as before.
void FlightTool::clickedCavity(Pixel at, Qt::KeyboardModifiers modifiers)
{
    const PlaneView& view = *reading_.shownOverview();
    const auto place = roomiestAlong(reading_.scan()->lumen, view.pointAt(at), view.forward());
    if (!place) {
        reading_.say(tr("The lumen is not there."));
        return;
    }
    if (reading_.click({*reading_.scan(), {}, *place, modifiers, false}))
        return;
    const Pose now = navigator()->state().pose;
    navigator()->lookFrom({*place, now.forward, now.up}, 0);
    reading_.flewOn();
    reading_.beginPass();
}

}  // namespace vicon::viewer
