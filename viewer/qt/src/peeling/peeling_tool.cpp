#include "peeling/peeling_tool.h"

#include "peeling/peeling_panel.h"
#include "reading/kept_place.h"
#include "reading/reading.h"
#include "widgets/kept_settings.h"
#include "window/reading_layout.h"

namespace vicon::viewer {

PeelingTool::PeelingTool(Reading& reading) : ReadingTool(reading), panel_(new PeelingPanel) {}

void PeelingTool::addTo(ReadingLayout& layout)
{
    layout.addPanel(panel_, ReadingLayout::PanelPlace::below_lists);
    panel_->showHistogramOn(reading_.views().endoscopic());
    connect(panel_, &PeelingPanel::changed, this, [this] {
        showTip();
        drawSoon();
    });
    connect(reading_.views().endoscopic(), &PictureView::hovered, this, [this](Pixel at) {
        mouse_at_ = at;
        if (panel_->on() && panel_->circleOnly())
            drawSoon();
    });
    showTip();
}

void PeelingTool::drawSoon()
{
    reading_.drawEndoscopic(false);
    reading_.drawSmoothlySoon();
}

void PeelingTool::restore()
{
    const CaseRecord& record = reading_.session().record();
    const QVariant once_with_the_case = keptSetting(keptKey(record, "peel"));
    panel_->choose(keptSetting(readerKey("peel"), once_with_the_case).toString(),
                   keptSetting(readerKey("peel_mm")).toDouble(), keptSetting(readerKey("peel_circle")).toBool(),
                   keptSetting(readerKey("peel_over")).toBool());
}

void PeelingTool::scanOpened(const Arrival&)
{
    const bool has_densities = reading_.scan()->files.quantity() == Quantity::density;
    panel_->setEnabled(has_densities);
    panel_->setToolTip(has_densities ? QString() : tr("Translucency shows densities, and MR has none."));
}

QVariantMap PeelingTool::kept() const
{
    return {{readerKey("peel"), panel_->preset()},
            {readerKey("peel_mm"), panel_->offset_mm()},
            {readerKey("peel_circle"), panel_->circleOnly()},
            {readerKey("peel_over"), panel_->overSurface()}};
}

void PeelingTool::complete(EndoscopicRequest& request) const
{
    if (panel_->isEnabled())
        panel_->fill(request.snapshot);
    request.snapshot.peel.circle_at = mouse_at_;
}

void PeelingTool::showTip()
{
    const bool circle_at_mouse = panel_->on() && panel_->circleOnly();  // a tip would lie over what is peeled
    reading_.views().endoscopic()->setToolTip(
        circle_at_mouse ? QString()
                        : tr("Click: slices there. Drag: steer. Wheel: on and back. Double click: "
                             "enlarge. Shift and click: marker."));
}

}  // namespace vicon::viewer
