#include <QAction>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QStatusBar>
#include <utility>

#include "kept_settings.h"
#include "reading_window.h"
#include "vicon/viewer/model/annotate.h"

namespace vicon::viewer {

void ReadingWindow::connectOpening()
{
    opening_ = new QWidget;
    opening_->setObjectName("opening");
    auto* bar = new QProgressBar(opening_);
    bar->setObjectName("openingBar");
    bar->setAccessibleName(tr("Progress of opening the scan"));
    auto* cancel = new QPushButton(tr("Cancel"), opening_);
    cancel->setObjectName("openingCancel");
    cancel->setToolTip(tr("Do not open this scan; where none is open yet, the window closes"));
    auto* row = new QHBoxLayout(opening_);
    row->setContentsMargins(0, 0, 0, 0);
    row->addWidget(bar);
    row->addWidget(cancel);
    statusBar()->addPermanentWidget(opening_);
    opening_->hide();
    connect(cancel, &QPushButton::clicked, this, &ReadingWindow::cancelOpening);
    connect(&session_, &CaseSession::opening, bar, [bar](int done, int of) {
        bar->setMaximum(of);
        bar->setValue(done);
    });
    connect(&session_, &CaseSession::openingFailed, this, [this] {
        opening_->hide();
        stayWhereOneIs();
    });
}

void ReadingWindow::openScan(const ScanRequest& request)
{
    tell(tr("Reading the scan ..."));
    opening_->show();
    left_ = session_.sharedScan();
    std::optional<ScanOpening::From> from;
    if (left_)
        from = ScanOpening::From{left_->record.id, left_->navigator.state().station_mm};
    scan_opening_.ask(request, from);
    session_.open(request.scan_id, request.read_again, wayOf(request.scan_id));
}

void ReadingWindow::offer(const std::vector<ScanRecord>& scans)
{
    for (const ScanRecord& scan : scans)
        scan_choice_->addItem(QString::fromStdString(positionName(scan.series.patient_position) + ", series " +
                                                     std::to_string(scan.series.number)),
                              QString::fromStdString(scan.id));
}

/// The one that was read last, where it is among them.
void ReadingWindow::openFirst(const std::vector<ScanRecord>& scans)
{
    offer(scans);
    const QString kept = "place/" + QString::fromStdString(session_.record().id) + "/scan";
    scan_choice_->setCurrentIndex(std::max(0, scan_choice_->findData(keptSetting(kept))));
    ScanRequest request;
    request.scan_id = scan_choice_->currentData().toString().toStdString();
    openScan(request);
}

void ReadingWindow::renew(const WorklistCase& row)
{
    const bool none_before = session_.scans().empty();
    const std::vector<ScanRecord> ready = session_.renew(row);
    if (none_before && !ready.empty()) {
        warn({});
        openFirst(ready);
    } else if (!ready.empty()) {
        offer(ready);
        tell(tr("Another scan of this case can be read now (X; C: side by side)."));
    }
    for (const WorklistScan& scan : row.scans)
        if (session_.scan() && scan.record.id == session_.scan()->record.id)
            takeOver(scan);
}

/// Its old files are gone: what is marked gets its distances on the new path.
void ReadingWindow::takeOver(const WorklistScan& row)
{
    ScanObserved observed;
    observed.scan_id = row.record.id;
    observed.in_work = row.state == WorkState::queued || row.state == WorkState::running;
    observed.readable = row.ready();
    observed.made_anew = madeAt(row.folder) != session_.scan()->made;
    observed.own_work = corrector_.busy();
    if (const auto request = scan_opening_.observed(observed))
        changeScan(*request);
}

void ReadingWindow::stayWhereOneIs()
{
    scan_opening_.giveUp();
    left_.reset();
    if (session_.scan())
        showWays();
    if (session_.scan())
        scan_choice_->setCurrentIndex(scan_choice_->findData(QString::fromStdString(session_.scan()->record.id)));
}

void ReadingWindow::cancelOpening()
{
    session_.cancelOpening();
    opening_->hide();
    if (!session_.scan()) {
        close();
        return;
    }
    stayWhereOneIs();
    tell(tr("Not opened; you read on in the scan that was open."));
}

void ReadingWindow::changeScan(const ScanRequest& request)
{
    savePlace();
    keepSeen();
    openScan(request);
}

void ReadingWindow::scanOpened()
{
    opening_->hide();
    endoscopic_->setAccessibleDescription({});  // its picture is still to come
    scan_choice_->setCurrentIndex(scan_choice_->findData(QString::fromStdString(session_.scan()->record.id)));
    beside_place_.reset();
    overview_shown_ = false;
    interaction_.scanChanged();
    measured_way_.clear();
    circle_.reset();
    focus_.reset();
    warning_->clear();
    tell({});
    useWords(organWords());
    kept_window_.clear();
    showWays();
    const Arrival arrival = scan_opening_.opened(session_.scan()->record.id);
    restorePlace(arrival);
    markersChanged();
    clock_.start();
    timer_.start();
    moved(true);
    showSeen();
    listUnseen();
    corrector_.findBridges(session_.scan()->record);
    if (compare_->isChecked())
        setBeside(true);
    if (const auto marker = session_.marker(arrival.marker_id.value_or("")))
        showMarker(*marker);
    if (arrival.place_markers) {
        session_.placeAnew();
        sayWhatIsNotAdded();
    }
    if (arrival.redone_by_other)
        warn(
            tr("This scan was done again meanwhile, after a correction by another reader or by 'vicon work'; this is "
               "the new result."));
}

}  // namespace vicon::viewer
