// The part of CaseSession that measures, on the loader's thread.
#include "session/case_session.h"
#include "vicon/viewer/scene/measures_picture.h"

namespace vicon::viewer {
namespace {
constexpr const char *kBiopsy = "biopsy", *kMeasures = "measures";

std::string nameOf(int request)
{
    return "measure " + std::to_string(request);
}

}  // namespace

void CaseSession::giveUpMeasuring(int request)
{
    loader_.giveUp(nameOf(request));
    measuring_.erase(request);
}

void CaseSession::giveUpMeasuring()
{
    while (!measuring_.empty())
        giveUpMeasuring(*measuring_.begin());
    loader_.giveUp(kBiopsy);
}

void CaseSession::giveUpMeasures()
{
    giveUpMeasuring();
    loader_.giveUp(kMeasures);
    emit measuringGivenUp();
}

void CaseSession::startMeasuring(int request, const std::shared_ptr<OpenScan>& scan, Measuring work)
{
    measuring_.insert(request);
    loader_.postTask(nameOf(request),
                     [this, request, scan, work = std::move(work)](const Progress& wanted) -> Worker::Work {
                         const auto failed = [this, request] {
                             measuring_.erase(request);
                             emit notMeasured(request);
                         };
                         try {
                             return [this, request, scan, failed, done = work(wanted)] {
                                 if (scan == openScan(scan->record.id)) {
                                     measuring_.erase(request);
                                     done();
                                 } else {
                                     failed();
                                     emit warned(tr("The scan was read anew meanwhile: measure in it once more."));
                                 }
                             };
                         } catch (...) {
                             if (!wanted.cancelled())
                                 QMetaObject::invokeMethod(this, failed, Qt::QueuedConnection);
                             throw;
                         }
                     });
}

std::shared_ptr<OpenScan> CaseSession::openScan(const std::string& id) const
{
    for (const auto& open : {scan_, beside_})
        if (open && open->record.id == id)
            return open;
    return {};
}

void CaseSession::measure(int request, const std::string& scan_id, Point3 from, Point3 to, Point3 eye)
{
    const auto scan = openScan(scan_id);
    if (!scan)
        return;
    startMeasuring(request, scan, [this, request, scan, from, to, eye](const Progress& wanted) -> Worker::Work {
        const auto& cells = scan->files.cells();
        const auto size = distanceOverWall(cells.points_mm, cells.triangles, from, to, &wanted);
        const auto plane = sizeOnBestPlane(scan->files.inside(), from, to, eye, &wanted);
        return [this, request, size, plane] {
            if (size) {
                emit measured(request, *size, plane);
            } else {
                emit warned(tr("No way over the wall joins the two points; measure them straight, in a slice."));
                emit notMeasured(request);
            }
        };
    });
}

void CaseSession::outlinePolyp(int request, const std::string& scan_id, Point3 at)
{
    const auto scan = openScan(scan_id);
    if (!scan)
        return;
    startMeasuring(request, scan, [this, request, scan, at](const Progress& wanted) -> Worker::Work {
        const PolypOutline outline = vicon::outlinePolyp(scan->files.cells(), scan->files.inside(), at,
                                                         blurAndNoiseOf(scan->files.folder()), &wanted);
        return [this, request, outline] { emit outlined(request, outline); };
    });
}

void CaseSession::takeBiopsy(Point3 centre, double radius_mm, const std::optional<CircledWall>& wall)
{
    loader_.giveUp(kBiopsy);
    loader_.postTask(kBiopsy, [this, scan = scan_, centre, radius_mm, wall](const Progress& wanted) -> Worker::Work {
        const DensitySample biopsy =
            sampleDensity(scan->files.volume(), scan->files.inside(), centre, radius_mm, wall, &wanted);
        return [this, scan, biopsy] {
            if (scan == scan_)
                emit biopsied(biopsy);
        };
    });
}

void CaseSession::drawMeasures(const Marker& marker, int side_px)
{
    const auto& scan = beside_ && beside_->record.id == marker.scan_id ? beside_ : scan_;
    if (!scan || scan->record.id != marker.scan_id)
        return;
    loader_.giveUp(kMeasures);
    loader_.postTask(kMeasures, [this, scan, marker, side_px](const Progress& wanted) -> Worker::Work {
        const auto picture = measuresPicture(scan->files, marker, scan->caption, side_px, 1, &wanted);
        if (!picture)
            return {};
        return [this, id = QString::fromStdString(marker.id), drawn = *picture] { emit measuresDrawn(id, drawn); };
    });
}

}  // namespace vicon::viewer
