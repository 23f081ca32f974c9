// The part of CaseSession that measures, on the loader's thread.
#include "session/case_session.h"
#include "vicon/viewer/scene/measures_picture.h"

namespace vicon::viewer {
namespace {
constexpr const char *kMeasure = "measure", *kOutline = "outline", *kBiopsy = "biopsy", *kMeasures = "measures";
}

void CaseSession::giveUpMeasuring()
{
    for (const char* name : {kMeasure, kOutline, kBiopsy})
        loader_.giveUp(name);
}

void CaseSession::giveUpMeasures()
{
    giveUpMeasuring();
    loader_.giveUp(kMeasures);
}

std::shared_ptr<OpenScan> CaseSession::openScan(const std::string& id) const
{
    for (const auto& open : {scan_, beside_})
        if (open && open->record.id == id)
            return open;
    return {};
}

void CaseSession::measure(const std::string& scan_id, Point3 from, Point3 to, Point3 eye)
{
    const auto of = openScan(scan_id);
    if (!of)
        return;
    loader_.giveUp(kMeasure);
    loader_.postTask(kMeasure, [this, scan = of, from, to, eye](const Progress& wanted) -> Worker::Work {
        const auto& cells = scan->files.cells();
        const auto size = distanceOverWall(cells.points_mm, cells.triangles, from, to, &wanted);
        const auto plane = sizeOnBestPlane(scan->files.inside(), from, to, eye, &wanted);
        return [this, scan, size, plane] {
            if (scan != openScan(scan->record.id))
                return;
            if (size)
                emit measured(scan->record.id, *size, plane);
            else
                emit warned(tr("No way over the wall joins the two points; measure them straight, in a slice."));
        };
    });
}

void CaseSession::outlinePolyp(const std::string& scan_id, Point3 at)
{
    const auto of = openScan(scan_id);
    if (!of)
        return;
    loader_.giveUp(kOutline);
    loader_.postTask(kOutline, [this, scan = of, at](const Progress& wanted) -> Worker::Work {
        const PolypOutline outline = vicon::outlinePolyp(scan->files.cells(), scan->files.inside(), at,
                                                         blurAndNoiseOf(scan->files.folder()), &wanted);
        return [this, scan, outline] {
            if (scan == openScan(scan->record.id))
                emit outlined(scan->record.id, outline);
        };
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
