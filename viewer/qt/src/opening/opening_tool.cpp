#include "opening/opening_tool.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QProgressBar>
#include <QPushButton>
#include <utility>

#include "branches/kept_branch.h"
#include "reading/kept_place.h"
#include "reading/reading.h"
#include "vicon/viewer/model/annotate.h"
#include "widgets/kept_settings.h"
#include "window/reading_layout.h"

namespace vicon::viewer {

OpeningTool::OpeningTool(Reading& reading) : ReadingTool(reading)
{
    choice_ = new QComboBox;
    choice_->setObjectName("scan");
    choice_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    choice_->setAccessibleName(tr("Scan"));
    choice_->setToolTip(tr("Supine or prone; the other one opens at the same place of the colon (X)"));
    progress_ = new QWidget;
    progress_->setObjectName("opening");
    bar_ = new QProgressBar(progress_);
    bar_->setObjectName("openingBar");
    bar_->setAccessibleName(tr("Progress of opening the scan"));
    auto* cancel = new QPushButton(tr("Cancel"), progress_);
    cancel->setObjectName("openingCancel");
    cancel->setToolTip(tr("Do not open this scan; where none is open yet, the window closes"));
    auto* row = new QHBoxLayout(progress_);
    row->setContentsMargins(0, 0, 0, 0);
    row->addWidget(bar_);
    row->addWidget(cancel);
    connect(cancel, &QPushButton::clicked, this, &OpeningTool::cancel);
}

void OpeningTool::addTo(ReadingLayout& layout)
{
    layout.addChoice(choice_);
    layout.addStatus(progress_);
    progress_->hide();
    layout.addAction(ReadingMenu::view, tr("Other scan"), QKeySequence("X"), [this] { openOther(); });
    connect(choice_, qOverload<int>(&QComboBox::activated), this, [this](int) {
        ScanRequest request;
        request.scan_id = choice_->currentData().toString().toStdString();
        reading_.changeScan(request);
    });
    connect(&reading_, &Reading::scanWanted, this, &OpeningTool::open);
    const CaseSession& session = reading_.session();
    connect(&session, &CaseSession::opening, this, [this](int done, int of) {
        bar_->setMaximum(of);
        bar_->setValue(done);
    });
    connect(&session, &CaseSession::opened, this,
            [this] { reading_.arrive(opening_.opened(reading_.scan()->record.id)); });
    connect(&session, &CaseSession::openingFailed, this, [this] {
        progress_->hide();
        stayHere();
    });
}

QVariantMap OpeningTool::kept() const
{
    if (!reading_.scan())
        return {};
    return {{keptKey(reading_.session().record(), "scan"), QString::fromStdString(reading_.scan()->record.id)}};
}

void OpeningTool::openFirst()
{
    const CaseSession& session = reading_.session();
    if (session.scans().empty()) {
        reading_.warn(tr("No scan of this case can be read yet; the first one opens as soon as it can."));
        return;
    }
    offer(session.scans());
    choice_->setCurrentIndex(std::max(0, choice_->findData(keptSetting(keptKey(session.record(), "scan")))));
    ScanRequest request;
    request.scan_id = choice_->currentData().toString().toStdString();
    open(request);
}

void OpeningTool::open(const ScanRequest& request)
{
    reading_.say(tr("Reading the scan ..."));
    progress_->show();
    std::optional<ScanOpening::From> from;
    if (const OpenScan* scan = reading_.scan())
        from = ScanOpening::From{scan->record.id, scan->navigator.state().station_mm};
    opening_.ask(request, from);
    reading_.session().open(request.scan_id, request.read_again,
                            keptBranch(reading_.session().record(), request.scan_id));
}

void OpeningTool::offer(const std::vector<ScanRecord>& scans)
{
    for (const ScanRecord& scan : scans)
        choice_->addItem(QString::fromStdString(positionName(scan.series.patient_position) + ", series " +
                                                std::to_string(scan.series.number)),
                         QString::fromStdString(scan.id));
}

void OpeningTool::openOther()
{
    if (choice_->count() < 2) {
        reading_.warn(tr("This case has no other scan that can be read."));
        return;
    }
    choice_->setCurrentIndex((choice_->currentIndex() + 1) % choice_->count());
    emit choice_->activated(choice_->currentIndex());
}

void OpeningTool::renew(const WorklistCase& row)
{
    CaseSession& session = reading_.session();
    const bool none_before = session.scans().empty();
    const std::vector<ScanRecord> ready = session.renew(row);
    if (none_before && !ready.empty()) {
        reading_.warn({});
        openFirst();
    } else if (!ready.empty()) {
        offer(ready);
        reading_.say(tr("Another scan of this case can be read now (X; C: side by side)."));
    }
    for (const WorklistScan& scan : row.scans)
        if (reading_.scan() && scan.record.id == reading_.scan()->record.id)
            takeOver(scan);
        else
            takeOverBeside(scan);
}

/// Its old files are gone: what is marked gets its distances on the new path.
void OpeningTool::takeOver(const WorklistScan& row)
{
    ScanObserved observed;
    observed.scan_id = row.record.id;
    observed.in_work = row.state == WorkState::queued || row.state == WorkState::running;
    observed.readable = row.ready();
    observed.made_anew = madeAt(row.folder) != reading_.scan()->made;
    observed.own_work = reading_.redoesScan();
    if (const auto request = opening_.observed(observed))
        reading_.changeScan(*request);
}

void OpeningTool::takeOverBeside(const WorklistScan& row)
{
    CaseSession& session = reading_.session();
    const OpenScan* beside = session.beside();
    if (!beside || session.besideIsPrior() || beside->record.id != row.record.id || reading_.redoesScan())
        return;
    if (row.state == WorkState::queued || row.state == WorkState::running) {
        beside_in_work_ = row.record.id;
        return;
    }
    if (std::exchange(beside_in_work_, {}) != row.record.id || !row.ready() || madeAt(row.folder) == beside->made)
        return;
    session.placeAnew(
        tr("The scan beside was done again, after a correction by another reader or by 'vicon work'; its markers have "
           "their distances on the new centreline."));
    session.closeBeside();  // it is the old one
    session.openBeside(row.record.id);
}

void OpeningTool::showChoice()
{
    choice_->setCurrentIndex(choice_->findData(QString::fromStdString(reading_.scan()->record.id)));
}

void OpeningTool::stayHere()
{
    opening_.giveUp();
    if (!reading_.scan())
        return;
    showChoice();
    reading_.stay();
}

void OpeningTool::cancel()
{
    reading_.session().cancelOpening();
    progress_->hide();
    if (!reading_.scan()) {
        emit closeWanted();
        return;
    }
    stayHere();
    reading_.say(tr("Not opened; you read on in the scan that was open."));
}

void OpeningTool::scanOpened(const Arrival& arrival)
{
    progress_->hide();
    showChoice();
    reading_.say({});
    if (arrival.redone_by_other)
        reading_.warn(
            tr("This scan was done again meanwhile, after a correction by another reader or by 'vicon work'; this is "
               "the new result."));
}

}  // namespace vicon::viewer
