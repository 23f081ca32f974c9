#include "reading_time/reading_time_tool.h"

#include <QApplication>
#include <QEvent>
#include <QLabel>
#include <QWidget>
#include <cmath>
#include <utility>

#include "coverage/coverage_tool.h"
#include "reading/reading.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
namespace {

constexpr int kTick_ms = 1000;
constexpr qint64 kAway_ms = 60000;    // without a key, the mouse or a flight, nobody reads
constexpr double kLeastLogged_s = 5;  // a scan that was only passed through

QString minutes(double seconds)
{
    constexpr int kMinute_s = 60;
    const int whole = int(std::lround(seconds));
    return QString("%1:%2").arg(whole / kMinute_s).arg(whole % kMinute_s, 2, 10, QChar('0'));
}

}  // namespace

ReadingTimeTool::ReadingTimeTool(Reading& reading, const CoverageTool& coverage)
    : ReadingTool(reading), coverage_(coverage), text_(new QLabel)
{
    text_->setObjectName("readingTime");
    text_->setToolTip(tr("How long this scan has been read: minutes and seconds, without pauses"));
    timer_.setInterval(kTick_ms);
    connect(&timer_, &QTimer::timeout, this, &ReadingTimeTool::tick);
}

void ReadingTimeTool::addTo(ReadingLayout& layout)
{
    layout.addStatus(text_);
    qApp->installEventFilter(this);
}

bool ReadingTimeTool::eventFilter(QObject* object, QEvent* event)
{
    const bool by_hand = event->type() == QEvent::MouseMove || event->type() == QEvent::KeyPress ||
                         event->type() == QEvent::Wheel || event->type() == QEvent::MouseButtonPress;
    if (by_hand && isOfThisCase(qobject_cast<QWidget*>(object)))
        active_.start();
    return false;
}

/// In the case's window, the second one or a dialog of it; another case's window is open beside.
bool ReadingTimeTool::isOfThisCase(const QWidget* widget) const
{
    const QWidget* const of = text_->window();
    while (widget && widget != of)
        widget = widget->parentWidget();
    return widget != nullptr;
}

void ReadingTimeTool::scanOpened(const Arrival&)
{
    writeLeft();
    clock_.beginScan();
    active_.start();
    since_tick_.start();
    timer_.start();
}

void ReadingTimeTool::stop()
{
    timer_.stop();
    writeLeft();
}

void ReadingTimeTool::tick()
{
    const double passed_s = double(since_tick_.restart()) / 1000;
    const bool reading = isOfThisCase(QApplication::activeWindow()) && !active_.hasExpired(kAway_ms);
    clock_.pass(passed_s, reading, reading_.views().firstSlice() != nullptr);
    text_->setText(minutes(clock_.scan_s()));
}

void ReadingTimeTool::scanLeft()
{
    if (!reading_.scan() || !timer_.isActive())
        return;
    tick();
    if (clock_.scan_s() >= kLeastLogged_s)
        left_ = Read{reading_.scan()->record.id, tr("%1 min, %2 of it slices first; %3 % of the wall reviewed; %4")
                                                     .arg(minutes(clock_.scan_s()), minutes(clock_.slicesFirst_s()))
                                                     .arg(100 * reading_.scan()->coverage.fraction(), 0, 'f', 1)
                                                     .arg(coverage_.visitsInWords())};
}

void ReadingTimeTool::writeLeft()
{
    if (const auto left = std::exchange(left_, {}))
        reading_.session().log(AuditEvent::scan_read, left->scan_id, left->words);
}

}  // namespace vicon::viewer
