#include <QStatusBar>

#include "reading_window.h"

namespace vicon::viewer {
namespace {

constexpr double kBeside_mm = 10;  // a size belongs to a marker this near to its line

QString mm(double length)
{
    return QObject::tr("%1 mm").arg(length, 0, 'f', 1);
}

}  // namespace

void ReadingWindow::startMeasuring()
{
    measured_way_.clear();
    drawMeasured();
    begin(Measure{}, tr("Measure: click on the two ends, on the wall or in a slice; or arrows and Return"));
}

void ReadingWindow::measure(const MeasureBetween& size)
{
    showTool();
    if (size.on_wall) {
        tell(tr("Measuring ..."));
        session_.measure(size.from_mm, size.to_mm, shown_.place.pose.eye_mm);
    } else {
        showMeasured({distance(size.from_mm, size.to_mm), 0, {size.from_mm, size.to_mm}}, {});
    }
}

std::optional<Marker> ReadingWindow::markerBeside(const std::vector<Point3>& way) const
{
    std::optional<Marker> beside;
    double least = kBeside_mm;
    for (const Marker& marker : session_.markersOf(session_.scan()->record.id))
        for (const Point3 p : way)
            if (const double d = distance(p, marker.position_mm); d < least) {
                least = d;
                beside = marker;
            }
    return beside;
}

void ReadingWindow::showMeasured(const WallDistance& size, const std::optional<PlaneSize>& plane)
{
    measured_way_ = size.way_mm;
    drawMeasured();
    QString text = tr("%1 straight").arg(mm(size.straight_mm));
    if (size.along_mm > 0)
        text += tr(", %1 along the wall").arg(mm(size.along_mm));
    if (plane)
        text += tr(", %1 largest in the best plane").arg(mm(plane->diameter_mm));
    const auto marker = markerBeside(size.way_mm);
    if (!marker) {
        tell(text + tr("; no marker beside it to keep it with"));
        return;
    }
    Marker after = *marker;
    after.size = {.straight_mm = size.straight_mm,
                  .along_mm = size.along_mm > 0 ? std::optional(size.along_mm) : std::nullopt,
                  .from_mm = size.way_mm.front(),
                  .to_mm = size.way_mm.back(),
                  .plane = plane};
    session_.changeMarker(*marker, after, false, tr("%1; kept with %2").arg(text, QString::fromStdString(marker->id)));
}

void ReadingWindow::drawMeasured()
{
    QVector<QLineF> lines;
    for (std::size_t n = 1; n < measured_way_.size(); ++n) {
        const Projected a = project(shown_.place.pose, shown_.lens, measured_way_[n - 1]);
        const Projected b = project(shown_.place.pose, shown_.lens, measured_way_[n]);
        if (a.depth_mm > 0 && b.depth_mm > 0)
            lines << QLineF(a.at.x, a.at.y, b.at.x, b.at.y);
    }
    endoscopic_->setLines(lines);
}

}  // namespace vicon::viewer
