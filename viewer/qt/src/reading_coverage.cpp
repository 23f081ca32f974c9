#include <QLabel>

#include "coverage_panel.h"
#include "reading_window.h"

namespace vicon::viewer {
namespace {
constexpr int kKeep_ms = 10000;  // how often what was seen is written while it grows
}

void ReadingWindow::connectCoverage()
{
    connect(&studio_, &Studio::seenChanged, this, &ReadingWindow::showSeen);
    connect(&seen_keeper_, &SeenKeeper::failed, this, &ReadingWindow::warn);
    connect(&seen_keeper_, &SeenKeeper::found, this,
            [this](const std::vector<UnseenPatch>& patches, const std::shared_ptr<OpenScan>& scan) {
                if (scan == session_.sharedScan())
                    coverage_->show(patches, scan->files.parts());
            });
    connect(coverage_, &CoveragePanel::paintWanted, this, [this] {
        beginPass();
        drawEndoscopic(true);
    });
    connect(coverage_, &CoveragePanel::listWanted, this, &ReadingWindow::listUnseen);
    connect(coverage_, &CoveragePanel::forgetWanted, this, [this] {
        if (!session_.scan())
            return;
        session_.scan()->seen.forget();
        drawEndoscopic(true);
        listUnseen();
    });
    connect(coverage_, &CoveragePanel::flyWanted, this, [this](const UnseenPatch& patch) {
        if (!navigator())
            return;
        beginPass();
        navigator()->lookFrom(patch.view.pose, patch.view.station_mm);
        focus_ = patch.centre_mm;
        moved(true);
    });
    connect(navigation_, &NavigationPanel::jumpWanted, this, &ReadingWindow::beginPass);
    connect(navigation_, &NavigationPanel::lookBackWanted, this, &ReadingWindow::beginPass);
    connect(navigation_, &NavigationPanel::angleWanted, this, &ReadingWindow::setAngle);
    keep_seen_.setInterval(kKeep_ms);
    connect(&keep_seen_, &QTimer::timeout, this, &ReadingWindow::keepSeen);
    keep_seen_.start();
}

void ReadingWindow::beginPass()
{
    for (OpenScan* scan : {session_.scan(), session_.beside()})
        if (scan)
            scan->seen.beginPass();
}

void ReadingWindow::listUnseen()
{
    if (session_.scan())
        seen_keeper_.findUnseen(session_.sharedScan(), coverage_->least_mm2());
}

void ReadingWindow::showSeen()
{
    if (!session_.scan())
        return;
    coverage_->setSeen(session_.scan()->seen.fraction());
    seen_text_->setText(tr("%1 % seen").arg(int(session_.scan()->seen.fraction() * 1000) / 10.0, 0, 'f', 1));
}

bool ReadingWindow::paintsSeen() const
{
    return coverage_->paints();
}

void ReadingWindow::keepSeen()
{
    for (const auto& scan : {session_.sharedScan(), session_.sharedBeside()})
        if (scan)
            seen_keeper_.save(scan);
}

}  // namespace vicon::viewer
