#include "corrections/correction_tool.h"

#include <utility>

#include "corrections/colon_panel.h"
#include "reading/reading.h"
#include "vicon/viewer/model/annotate.h"
#include "vicon/viewer/model/outside_air.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
namespace {

constexpr double kBeside_mm = 4;  // a little more than a point may lie beside what it means

}  // namespace

CorrectionTool::CorrectionTool(Reading& reading, const ReadingServices& services, const std::string& case_id)
    : ReadingTool(reading), panel_(new ColonPanel), corrector_(services, case_id, this)
{
}

void CorrectionTool::addTo(ReadingLayout& layout)
{
    layout_ = &layout;
    layout.addList(panel_, tr("C&olon"));
    connectCorrector();
    connectPanel();
}

void CorrectionTool::connectCorrector()
{
    connect(&corrector_, &Corrector::told, &reading_, &Reading::say);
    connect(&corrector_, &Corrector::failed, &reading_, &Reading::warn);
    connect(&corrector_, &Corrector::historyChanged, this, [this] {
        emit reading_.historyChanged();
        if (reading_.scan())  // also after a refusal: then the list was out of date
            corrector_.findBridges(reading_.scan()->record);
    });
    connect(&corrector_, &Corrector::progressed, panel_, &ColonPanel::showProgress);
    connect(&corrector_, &Corrector::bridgesFound, this,
            [this](const std::vector<ReviewedBridge>& bridges, const QString& scan_id) {
                if (reading_.scan() && reading_.scan()->record.id == scan_id.toStdString())
                    panel_->show(bridges, reading_.scan()->files.skeleton());
            });
    connect(&corrector_, &Corrector::redone, this, &CorrectionTool::scanRedone);
}

void CorrectionTool::connectPanel()
{
    connect(panel_, &ColonPanel::stopWanted, &corrector_, &Corrector::stop);
    connect(panel_, &ColonPanel::correctionWanted, this, &CorrectionTool::start);
    connect(panel_, &ColonPanel::forgetWanted, this, [this] {
        if (reading_.scan())
            corrector_.forget(reading_.scan()->record);
    });
    connect(panel_, &ColonPanel::reviewed, this, [this](const ReviewedBridge& bridge, bool confirmed) {
        if (reading_.scan())
            corrector_.review(reading_.scan()->record, bridge, confirmed);
    });
    connect(panel_, &ColonPanel::flyWanted, &reading_, &Reading::lookAt);
}

void CorrectionTool::useWords(const OrganWords& words)
{
    layout_->enableList(panel_, words.organ.isColon(),
                        words.organ.isColon() ? tr("Bridges over collapsed segments, and corrections of the lumen")
                                              : tr("Bridges and corrections are a colon's; this scan shows the %1")
                                                    .arg(QString::fromStdString(words.organ.name())));
}

void CorrectionTool::scanOpened(const Arrival& arrival)
{
    const ScanRecord& scan = reading_.scan()->record;
    corrector_.findBridges(scan);
    if (arrival.place_markers)
        reading_.session().placeAnew(
            tr("The corrected scan is shown; its markers have their distances on the new centreline."));
    if (!corrector_.busy() && corrected_ && corrected_->scan_id == scan.id)
        sayWhatIsNotAdded();
}

void CorrectionTool::start(Correction kind)
{
    reading_.begin(Correct{kind}, kind == Correction::add
                                      ? tr("Click on the gas or fluid that belongs to the colon, in a slice")
                                  : kind == Correction::cut
                                      ? tr("Click into the lumen where it is cut across; the smaller part is dropped")
                                      : tr("Click on the piece that does not belong to the colon"));
}

void CorrectionTool::scanRedone(const QString& scan_id)
{
    if (!reading_.scan() || reading_.scan()->record.id != scan_id.toStdString()) {
        otherScanRedone(scan_id.toStdString());
        return;
    }
    ScanRequest request;
    request.scan_id = scan_id.toStdString();
    request.read_again = request.redone = true;
    reading_.changeScan(request);
}

/// The reader went on to another scan meanwhile: what was added is looked at when this one is opened again.
void CorrectionTool::otherScanRedone(const std::string& scan_id)
{
    CaseSession& session = reading_.session();
    QString name = QString::fromStdString(scan_id);
    for (const ScanRecord& scan : session.scans())
        if (scan.id == scan_id)
            name = QString::fromStdString(positionName(scan.series.patient_position));
    session.placeAnew(
        tr("The other scan (%1) is corrected, and its markers have their distances on the new centreline; X "
           "shows it.")
            .arg(name));
    if (session.beside() && session.beside()->record.id == scan_id) {
        session.closeBeside();  // it is the old one
        session.openBeside(scan_id);
    }
}

bool CorrectionTool::act(const ClickMeaning& meaning, const ClickedPoint& point)
{
    const auto* here = std::get_if<CorrectHere>(&meaning);
    if (here)
        correct(point, here->kind);
    return here != nullptr;
}

void CorrectionTool::correct(const ClickedPoint& point, Correction kind)
{
    const OpenScan& scan = point.scan;
    if (kind != Correction::add && !scan.lumen.inside(point.at_mm)) {
        reading_.warn(tr("There is no lumen at this point; click into the gas or fluid that is to be cut or dropped."));
        return;
    }
    const bool can_guess = kind == Correction::add && scan.files.quantity() == Quantity::density;
    const LumenGuess guess = can_guess ? guessLumen(scan.files.volume(), point.at_mm) : LumenGuess::possible;
    if (guess != LumenGuess::possible) {
        reading_.warn(
            guess == LumenGuess::outside_body
                ? tr("This is air outside the body; click into the gas or fluid that belongs to the colon.")
                : tr("There is neither gas nor tagged fluid at this point; click into what belongs to the colon."));
        return;
    }
    reading_.interaction().finish();
    reading_.toolChanged();
    corrected_ = Corrected{scan.record.id, kind, point.at_mm};
    corrector_.correct(scan.record, kind, point.at_mm);
}

void CorrectionTool::sayWhatIsNotAdded()
{
    const auto corrected = std::exchange(corrected_, {});
    const OpenScan& scan = *reading_.scan();
    if (corrected && corrected->kind == Correction::add && corrected->scan_id == scan.record.id &&
        !scan.lumen.nearestInside(corrected->at_mm, kBeside_mm).found)
        reading_.warn(
            tr("Nothing was added: there is no gas or tagged fluid at the place that you clicked, or it belongs to a "
               "piece that you dropped. Undo (Ctrl+Z) takes the correction back."));
}

}  // namespace vicon::viewer
