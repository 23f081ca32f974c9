#include <array>
#include <cmath>
#include <utility>

#include "colon_panel.h"
#include "corrector.h"
#include "reading_window.h"

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

void ReadingWindow::connectCorrections()
{
    connect(&corrector_, &Corrector::told, this, &ReadingWindow::tell);
    connect(&corrector_, &Corrector::failed, this, &ReadingWindow::warn);
    connect(&corrector_, &Corrector::historyChanged, this, [this] {
        showHistory();
        if (session_.scan())  // also after a refusal: then the list was out of date
            corrector_.findBridges(session_.scan()->record);
    });
    connect(&corrector_, &Corrector::progressed, colon_, &ColonPanel::showProgress);
    connect(&corrector_, &Corrector::bridgesFound, this,
            [this](const std::vector<ReviewedBridge>& bridges, const QString& scan_id) {
                if (session_.scan() && session_.scan()->record.id == scan_id.toStdString())
                    colon_->show(bridges, session_.scan()->files.skeleton());
            });
    connect(&corrector_, &Corrector::redone, this, [this](const QString& scan_id) {
        if (!session_.scan() || session_.scan()->record.id != scan_id.toStdString()) {
            corrected_.reset();
            session_.placeAnew();
            return;
        }
        ScanRequest request;
        request.scan_id = scan_id.toStdString();
        request.read_again = request.redone = true;
        changeScan(request);
    });
    connect(colon_, &ColonPanel::stopWanted, &corrector_, &Corrector::stop);
    connect(colon_, &ColonPanel::correctionWanted, this, [this](Correction kind) {
        begin(Correct{kind},
              kind == Correction::add   ? tr("Click on the gas or fluid that belongs to the colon, in a slice")
              : kind == Correction::cut ? tr("Click into the lumen where it is cut across; the smaller part is dropped")
                                        : tr("Click on the piece that does not belong to the colon"));
    });
    connect(colon_, &ColonPanel::forgetWanted, this, [this] {
        if (session_.scan())
            corrector_.forget(session_.scan()->record);
    });
    connect(colon_, &ColonPanel::reviewed, this, [this](const ReviewedBridge& bridge, bool confirmed) {
        if (session_.scan())
            corrector_.review(session_.scan()->record, bridge, confirmed);
    });
    connect(colon_, &ColonPanel::flyWanted, this, [this](Point3 point) {
        if (navigator())
            lookAt(point);
    });
}

void ReadingWindow::correct(const OpenScan& scan, Correction kind, Point3 point)
{
    if (kind != Correction::add && !scan.lumen.inside(point)) {
        warn(tr("There is no lumen at this point; click into the gas or fluid that is to be cut or dropped."));
        return;
    }
    if (kind == Correction::add && !mayBeLumen(scan.files.volume(), point)) {
        warn(tr("There is neither gas nor tagged fluid at this point; click into what belongs to the colon."));
        return;
    }
    interaction_.finish();
    showTool();
    corrected_ = Corrected{scan.record.id, kind, point};
    corrector_.correct(scan.record, kind, point);
}

void ReadingWindow::sayWhatIsNotAdded()
{
    const auto corrected = std::exchange(corrected_, {});
    const OpenScan& scan = *session_.scan();
    if (corrected && corrected->kind == Correction::add && corrected->scan_id == scan.record.id &&
        !scan.lumen.nearestInside(corrected->at_mm, kBeside_mm).found)
        warn(
            tr("Nothing was added: there is no gas or tagged fluid at the place that you clicked, or it belongs to a "
               "piece that you dropped. Undo (Ctrl+Z) takes the correction back."));
}

}  // namespace vicon::viewer
