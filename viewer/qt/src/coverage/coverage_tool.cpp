#include "coverage/coverage_tool.h"

#include <QLabel>

#include "coverage/coverage_panel.h"
#include "reading/kept_place.h"
#include "reading/reading.h"
#include "widgets/kept_settings.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
namespace {
constexpr int kKeep_ms = 10000;  // how often what was seen is written while it grows
constexpr const char* kPaint = "paint";
}  // namespace

CoverageTool::CoverageTool(Reading& reading) : ReadingTool(reading), panel_(new CoveragePanel), seen_text_(new QLabel)
{
    seen_text_->setObjectName("seenText");
    seen_text_->setToolTip(tr("Part of the wall seen so far"));
}

void CoverageTool::addTo(ReadingLayout& layout)
{
    layout.addList(panel_, tr("&Unseen"));
    layout.addStatus(seen_text_);
    layout.addAction(ReadingMenu::view, tr("Paint what was seen"), QKeySequence("V"),
                     [this] { panel_->setPaints(!panel_->paints()); });
    connect(&layout, &ReadingLayout::listShown, this, [this](const QWidget* list) {
        if (list == panel_)
            listUnseen();
    });
    connect(&reading_.drawing(), &DrawingThread::seenChanged, this, &CoverageTool::showSeen);
    connect(&keeper_, &CoverageKeeper::failed, &reading_, &Reading::warn);
    connect(&keeper_, &CoverageKeeper::found, this,
            [this](const std::vector<UnseenPatch>& patches, const std::shared_ptr<OpenScan>& scan) {
                if (scan == reading_.sharedScan())
                    panel_->show(patches, scan->files.parts());
            });
    connectPanel();
    keep_timer_.setInterval(kKeep_ms);
    connect(&keep_timer_, &QTimer::timeout, this, &CoverageTool::keep);
    keep_timer_.start();
}

void CoverageTool::connectPanel()
{
    connect(panel_, &CoveragePanel::paintWanted, this, [this] {
        reading_.beginPass();
        reading_.drawEndoscopic(true);
    });
    connect(panel_, &CoveragePanel::listWanted, this, &CoverageTool::listUnseen);
    connect(panel_, &CoveragePanel::forgetWanted, this, [this] {
        if (!reading_.scan())
            return;
        reading_.scan()->coverage.forget();
        reading_.drawEndoscopic(true);
        listUnseen();
    });
    connect(panel_, &CoveragePanel::flyWanted, this,
            [this](const UnseenPatch& patch) { reading_.lookFrom(patch.view, patch.centre_mm); });
}

void CoverageTool::restore()
{
    panel_->setPaints(keptSetting(keptKey(reading_.session().record(), kPaint)).toBool());
}

QVariantMap CoverageTool::kept() const
{
    return {{keptKey(reading_.session().record(), kPaint), panel_->paints()}};
}

void CoverageTool::useWords(const OrganWords& words)
{
    panel_->setStationTip(stationTip(words));
}

void CoverageTool::scanOpened(const Arrival&)
{
    showSeen();
    listUnseen();
}

void CoverageTool::style(EndoscopicRequest& request) const
{
    request.paint_seen = panel_->paints();
}

void CoverageTool::listUnseen()
{
    if (reading_.scan())
        keeper_.findUnseen(reading_.sharedScan(), panel_->least_mm2());
}

void CoverageTool::showSeen()
{
    if (!reading_.scan())
        return;
    const double fraction = reading_.scan()->coverage.fraction();
    panel_->setSeen(fraction);
    seen_text_->setText(tr("%1 % seen").arg(int(fraction * 1000) / 10.0, 0, 'f', 1));
}

void CoverageTool::keep()
{
    for (const auto& scan : {reading_.sharedScan(), reading_.session().sharedBeside()})
        if (scan)
            keeper_.save(scan);
}

}  // namespace vicon::viewer
