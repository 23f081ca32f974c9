// What the controls, the keys and the mouse do to the flight.
#include <QAction>
#include <QKeyEvent>

#include "flight/flight_tool.h"
#include "flight/navigation_panel.h"
#include "reading/reading.h"
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
    add(tr("Jump to a distance"), "J", [this] { panel_->askStation(); });
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

}  // namespace vicon::viewer
