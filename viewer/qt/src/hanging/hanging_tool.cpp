#include "hanging/hanging_tool.h"

#include "reading/kept_place.h"
#include "reading/reading.h"
#include "slices/slice_tool.h"
#include "widgets/kept_settings.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
namespace {

constexpr int kFirstFunctionKey = 5;

QString nameOfKey(std::size_t which)
{
    return QString("F%1").arg(kFirstFunctionKey + int(which));
}

QString hangingKey(const QString& of)
{
    return readerKey("hanging_" + of);
}

}  // namespace

HangingTool::HangingTool(Reading& reading, SliceTool& slices) : ReadingTool(reading), slices_(slices) {}

void HangingTool::addTo(ReadingLayout& layout)
{
    for (std::size_t n = 0; n < kHangings; ++n)
        layout.addAction(ReadingMenu::view,
                         tr("Hanging: %1").arg(QString::fromStdString(nameOf(usualHangings()[n].layout))),
                         QKeySequence(nameOfKey(n)), [this, n] { hang(hangings_[n]); });
    for (std::size_t n = 0; n < kHangings; ++n)
        layout.addAction(ReadingMenu::view, tr("Keep what is shown as %1").arg(nameOfKey(n)),
                         QKeySequence("Shift+" + nameOfKey(n)), [this, n] { keepAs(n); });
    layout.addAction(ReadingMenu::slices, tr("Plane of the large slice"), QKeySequence("H"), [this] { nextPlane(); });
}

void HangingTool::restore()
{
    const auto kept = [](const QString& of, const Hanging& otherwise) {
        return hangingFrom(keptSetting(hangingKey(of)).toString().toStdString(), otherwise);
    };
    for (std::size_t n = 0; n < kHangings; ++n)
        hangings_[n] = kept(nameOfKey(n), hangings_[n]);
    hang(kept("now", hangings_.front()));
}

QVariantMap HangingTool::kept() const
{
    QVariantMap values{{hangingKey("now"), QString::fromStdString(toText(now()))}};
    for (std::size_t n = 0; n < kHangings; ++n)
        values[hangingKey(nameOfKey(n))] = QString::fromStdString(toText(hangings_[n]));
    return values;
}

Hanging HangingTool::now() const
{
    return {reading_.views().layoutNow(), reading_.views().plane(), slices_.look()};
}

void HangingTool::hang(const Hanging& hanging)
{
    reading_.views().layOut(hanging.layout, hanging.plane);
    slices_.setLook(hanging.slices);
}

void HangingTool::keepAs(std::size_t which)
{
    hangings_[which] = now();
    reading_.say(tr("%1 hangs every case like this from now on.").arg(nameOfKey(which)));
}

/// Where a slice is large.
void HangingTool::nextPlane()
{
    constexpr int kPlanes = int(SlicePlane::across) + 1;
    if (reading_.views().layoutNow() == ViewLayout::three_d_first) {
        reading_.say(tr("No slice is large here; F6 shows one."));
        return;
    }
    Hanging hanging = now();
    hanging.plane = SlicePlane((int(hanging.plane) + 1) % kPlanes);
    hang(hanging);
}

}  // namespace vicon::viewer
