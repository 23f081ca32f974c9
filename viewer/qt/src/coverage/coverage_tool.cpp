#include "coverage/coverage_tool.h"

#include <QLabel>
#include <QPixmap>
#include <algorithm>
#include <chrono>
#include <utility>

#include "coverage/coverage_panel.h"
#include "reading/kept_place.h"
#include "reading/reading.h"
#include "vicon/viewer/model/review_rule.h"
#include "widgets/kept_settings.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
namespace {

constexpr int kKeep_ms = 10000;  // how often what was reviewed is written while it grows
constexpr const char* kPaint = "paint";
constexpr const char* kLeastMissed = "least_missed_mm2";

double now_s()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

CoverageTool::CoverageTool(Reading& reading)
    : ReadingTool(reading),
      panel_(new CoveragePanel),
      seen_text_(new QLabel),
      still_timer_(
          int(kLeastShown_s * 1000), [this] { countStill(); }, Qt::PreciseTimer)
{
    seen_text_->setObjectName("seenText");
    seen_text_->setToolTip(tr("Share of the wall reviewed so far"));
}

void CoverageTool::addTo(ReadingLayout& layout)
{
    layout_ = &layout;
    layout.addList(panel_, tr("Missed"));
    layout.addStatus(seen_text_);
    addActions(layout);
    connectDrawing();
    connectPanel();
    keep_timer_.setInterval(kKeep_ms);
    connect(&keep_timer_, &QTimer::timeout, this, &CoverageTool::keep);
    keep_timer_.start();
}

void CoverageTool::addActions(ReadingLayout& layout)
{
    layout.addAction(ReadingMenu::view, tr("Paint what was reviewed"), QKeySequence("V"),
                     [this] { panel_->setPaints(!panel_->paints()); });
    layout.addAction(ReadingMenu::edit, tr("Next missed region"), QKeySequence("F3"), [this] { next(); });
    connect(&layout, &ReadingLayout::listShown, this, [this](const QWidget* list) {
        const bool gone_through = !missed_.visited() || !missed_.next();
        if (list == panel_ && gone_through)
            listMissed();  // what is being gone through is not taken away
    });
}

void CoverageTool::connectDrawing()
{
    // The next picture counts for itself.
    connect(&reading_, &Reading::endoscopicShown, this, [this] { still_timer_.stop(); });
    connect(&reading_.drawing(), &DrawingThread::seenChanged, this, [this] {
        still_timer_.start();
        showSeen();
    });
    connect(&reading_.drawing(), &DrawingThread::missedDrawn, this,
            [this](const MissedRow& row, const Picture& picture, const std::shared_ptr<OpenScan>& of) {
                if (of != reading_.sharedScan() || row.list != list_)
                    return;
                const QImage image(picture.rgb.data(), picture.width, picture.height, 3 * picture.width,
                                   QImage::Format_RGB888);
                panel_->setPicture(row.region, QPixmap::fromImage(image.copy()));
                drawPicture(row.region + 1);
            });
    connect(&keeper_, &CoverageKeeper::failed, &reading_, &Reading::warn);
    connect(&keeper_, &CoverageKeeper::summedUp, this, &CoverageTool::summedUp);
    connect(&keeper_, &CoverageKeeper::found, this,
            [this](const std::vector<UnseenPatch>& patches, const std::shared_ptr<OpenScan>& scan) {
                if (scan == reading_.sharedScan())
                    showList(patches);
            });
}

void CoverageTool::connectPanel()
{
    connect(panel_, &CoveragePanel::paintWanted, this, [this] {
        reading_.beginPass();
        reading_.drawEndoscopic(true);
    });
    connect(panel_, &CoveragePanel::listWanted, this, &CoverageTool::listMissed);
    connect(panel_, &CoveragePanel::nextWanted, this, &CoverageTool::next);
    connect(panel_, &CoveragePanel::forgetWanted, this, [this] {
        if (!reading_.scan())
            return;
        reading_.scan()->coverage.forget();
        missed_ = {};  // what was looked at as well
        reading_.drawEndoscopic(true);
        reading_.drawOverview(true);
        showSeen();
        listMissed();
    });
    connect(panel_, &CoveragePanel::flyWanted, this, [this](int region) { flyTo(std::size_t(region)); });
}

void CoverageTool::restore()
{
    panel_->setPaints(keptSetting(readerKey(kPaint)).toBool());
    panel_->setLeast(keptSetting(readerKey(kLeastMissed), panel_->least_mm2()).toDouble());
}

QVariantMap CoverageTool::kept() const
{
    return {{readerKey(kPaint), panel_->paints()}, {readerKey(kLeastMissed), panel_->least_mm2()}};
}

void CoverageTool::useWords(const OrganWords& words)
{
    panel_->setStationTip(stationTip(words));
}

void CoverageTool::scanLeft()
{
    leaveRegion();
    keep();
}

void CoverageTool::scanOpened(const Arrival&)
{
    next_when_listed_ = false;  // asked for in the scan before
    missed_ = {};
    showList({});
    showSeen();
    listMissed();
}

void CoverageTool::escape()
{
    if (!highlighted_)
        return;
    leaveRegion();
    reading_.drawEndoscopic(true);
}

void CoverageTool::style(EndoscopicRequest& request) const
{
    request.paint_seen = panel_->paints();
}

void CoverageTool::complete(EndoscopicRequest& request) const
{
    request.missed = highlighted_;
}

void CoverageTool::stop()
{
    keep_timer_.stop();
    still_timer_.stop();
}

void CoverageTool::listMissed()
{
    if (reading_.scan())
        keeper_.findUnseen(reading_.sharedScan(), panel_->least_mm2());
}

void CoverageTool::showList(const std::vector<UnseenPatch>& patches)
{
    leaveRegion();
    ++list_;
    missed_ = missed_.listedAnew(patches);
    panel_->show(missed_, reading_.scan()->files.parts());
    drawPicture(0);
    if (!std::exchange(next_when_listed_, false))
        return;
    if (const auto region = missed_.next())
        flyTo(*region);
    else
        reading_.say(tr("No region of %1 mm² or more is missed.").arg(panel_->least_mm2(), 0, 'f', 0));
}

void CoverageTool::drawPicture(int region)
{
    if (!reading_.scan() || region >= int(missed_.regions().size()))
        return;
    const UnseenPatch& patch = missed_.regions()[std::size_t(region)];
    const NavigationState at{patch.view.pose, patch.view.station_mm, patch.view.clearance_mm, false, false};
    EndoscopicRequest request = reading_.requestFor(*reading_.scan(), at, CoveragePanel::pictureSize(), true);
    request.snapshot.captioned = false;
    request.snapshot.text_px = 0;
    request.snapshot.markers.clear();
    request.snapshot.priors.clear();
    request.missed = std::make_shared<const std::vector<std::uint8_t>>(
        missed_.trianglesOf(std::size_t(region), reading_.scan()->files.cells().triangleCount()));
    reading_.drawing().drawMissed(reading_.sharedScan(), request, {list_, region});
}

/// Of the list that is gone through; else of a new one.
void CoverageTool::next()
{
    layout_->showList(panel_);
    const auto region = missed_.next();
    if (missed_.visited() && region) {
        flyTo(*region);
        return;
    }
    next_when_listed_ = true;
    listMissed();
}

void CoverageTool::flyTo(std::size_t region)
{
    if (!reading_.scan() || region >= missed_.regions().size())
        return;
    missed_.visit(region);
    panel_->mark(missed_);
    const UnseenPatch& patch = missed_.regions()[region];
    highlighted_ = std::make_shared<const std::vector<std::uint8_t>>(
        missed_.trianglesOf(region, reading_.scan()->files.cells().triangleCount()));
    reading_.lookFrom(patch.view, patch.centre_mm);
    reading_.say(tr("Missed region %1 of %2, %3 mm²: F3 for the next one.")
                     .arg(region + 1)
                     .arg(missed_.regions().size())
                     .arg(patch.area_mm2, 0, 'f', 0));
}

void CoverageTool::pointLeft()
{
    constexpr double kNear_mm = 60;  // nearer, the reader still looks at the region from other sides
    if (!highlighted_ || !missed_.visited())
        return;
    const Point3 region = missed_.regions()[*missed_.visited()].centre_mm;
    if (distance(region, reading_.navigator()->state().pose.eye_mm) > kNear_mm)
        leaveRegion();
}

void CoverageTool::leaveRegion()
{
    highlighted_.reset();
}

void CoverageTool::countStill()
{
    if (!reading_.scan())
        return;
    reading_.scan()->coverage.stillShown(now_s(), kLeastShown_s);
    showSeen();
    reading_.drawOverview(true);
}

void CoverageTool::showSeen()
{
    if (!reading_.scan())
        return;
    const ScanCoverage& seen = reading_.scan()->coverage;
    const double fraction = seen.fraction();
    panel_->setSeen(fraction);
    seen_text_->setText(tr("%1 % reviewed").arg(int(fraction * 1000) / 10.0, 0, 'f', 1));
    if (missed_.next() && missed_.tick(seen.coverage()))
        panel_->mark(missed_);
}

void CoverageTool::sumUp()
{
    const CaseSession& session = reading_.session();
    std::vector<ScanToReview> scans;
    for (const ScanRecord& scan : session.scans()) {
        ScanToReview which{scan, session.folderOf(scan.id), {}};
        for (const auto& open : {reading_.sharedScan(), session.sharedBeside()})
            if (open && open->record.case_id == scan.case_id && open->record.id == scan.id)
                which.open = open;
        scans.push_back(std::move(which));
    }
    keeper_.sumUp(std::move(scans));
}

QString CoverageTool::visitsInWords() const
{
    return tr("%1 of %2 missed regions looked at").arg(missed_.countLookedAt()).arg(missed_.countListed());
}

void CoverageTool::keep()
{
    for (const auto& scan : {reading_.sharedScan(), reading_.session().sharedBeside()})
        if (scan)
            keeper_.save(scan);
}

}  // namespace vicon::viewer
