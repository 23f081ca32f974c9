#include "corrections/correction_tool.h"

#include <array>
#include <cmath>
#include <utility>

#include "corrections/colon_panel.h"
#include "reading/reading.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
namespace {

constexpr double kBeside_mm = 4;  // a little more than a point may lie beside what it means

/// Whether the pipeline might find gas or tagged fluid about a point: what is certainly tissue is not asked for.
bool mayBeLumen(const HuView& volume, Point3 point)
{
    constexpr int kPerhapsGas_hu = -400, kPerhapsFluid_hu = 100;
    const Grid& grid = volume.grid;
    const Index3 middle = grid.indexAt(point);
    std::array<int, 3> reach{};
    for (std::size_t d = 0; d < 3; ++d)
        reach[d] = int(std::ceil(kBeside_mm / grid.spacing_mm[d]));
    for (int k = middle.k - reach[2]; k <= middle.k + reach[2]; ++k)
        for (int j = middle.j - reach[1]; j <= middle.j + reach[1]; ++j)
            for (int i = middle.i - reach[0]; i <= middle.i + reach[0]; ++i)
                if (const int hu = volume.valueOr({i, j, k}, 0); hu < kPerhapsGas_hu || hu > kPerhapsFluid_hu)
                    return true;
    return false;
}

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
    layout_->enableList(panel_, words.isColon(),
                        words.isColon() ? tr("Bridges over collapsed parts, and corrections of the lumen")
                                        : tr("Bridges and corrections are a colon's; this scan shows the %1")
                                              .arg(QString::fromStdString(words.organ)));
}

void CorrectionTool::scanOpened(const Arrival& arrival)
{
    corrector_.findBridges(reading_.scan()->record);
    if (!arrival.place_markers)
        return;
    reading_.session().placeAnew();
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
        corrected_.reset();
        reading_.session().placeAnew();
        return;
    }
    ScanRequest request;
    request.scan_id = scan_id.toStdString();
    request.read_again = request.redone = true;
    reading_.changeScan(request);
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
    if (kind == Correction::add && !mayBeLumen(scan.files.volume(), point.at_mm)) {
        reading_.warn(tr("There is neither gas nor tagged fluid at this point; click into what belongs to the colon."));
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
