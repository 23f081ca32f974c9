// What is known of the chosen marker, in a window of its own.
#include <QGridLayout>
#include <QLabel>
#include <QMessageBox>

#include "markers/marker_table.h"
#include "markers/marker_tool.h"
#include "reading/reading.h"
#include "vicon/viewer/model/annotate.h"
#include "widgets/length_text.h"

namespace vicon::viewer {
namespace {

QString row(const QString& name, const QString& value)
{
    if (value.isEmpty())
        return {};
    return QString("<tr><td><b>%1</b>&nbsp;&nbsp;</td><td>%2</td></tr>")
        .arg(name.toHtmlEscaped(), value.toHtmlEscaped());
}

QString words(const std::string& utf8)
{
    return QString::fromStdString(utf8);
}

QString sizeWords(const Marker& marker)
{
    if (!marker.size)
        return {};
    return sizeText(*marker.size);
}

QString densityWords(const Marker& marker)
{
    if (!marker.density)
        return {};
    const DensitySample& sample = *marker.density;
    return QObject::tr("%1 \u00b1 %2 HU, of %3 voxels within %4")
        .arg(sample.mean_hu, 0, 'f', 0)
        .arg(sample.sd_hu, 0, 'f', 0)
        .arg(sample.voxels)
        .arg(lengthText(sample.radius_mm));
}

QString informationOf(const Marker& marker, const QString& scan, const OrganWords& organ)
{
    const Point3 p = marker.position_mm;
    const auto from = [&organ](const std::string& end, double mm) {
        return row(QObject::tr("From the %1").arg(words(end)), organ.has_path ? lengthText(mm) : QString());
    };
    return "<table>" + row(QObject::tr("Marker"), words(marker.id + ", " + nameOf(marker.color))) +
           row(QObject::tr("Scan"), scan) +
           row(QObject::tr("Segment"), marker.part ? words(nameOf(*marker.part)) : QString()) +
           from(organ.first_end, marker.station_mm) + from(organ.last_end, marker.from_caecum_mm) +
           row(QObject::tr("LPS"),
               QObject::tr("%1, %2, %3 mm").arg(p.x, 0, 'f', 1).arg(p.y, 0, 'f', 1).arg(p.z, 0, 'f', 1)) +
           row(QObject::tr("Size"), sizeWords(marker)) + row(QObject::tr("Density"), densityWords(marker)) +
           row(QObject::tr("Same finding"), words(partnerNames(marker))) +
           row(QObject::tr("Note"), words(marker.note)) + row(QObject::tr("Placed"), words(marker.created)) +
           row(QObject::tr("Changed"), words(marker.changed)) + "</table>";
}

void addMeasures(QMessageBox& box, const Picture& drawn)
{
    const QImage image(drawn.rgb.data(), drawn.width, drawn.height, 3 * drawn.width, QImage::Format_RGB888);
    auto* label = new QLabel(&box);
    label->setObjectName("measures");
    label->setAccessibleName(QObject::tr("Best plane and densities"));
    label->setPixmap(QPixmap::fromImage(image));
    auto* grid = qobject_cast<QGridLayout*>(box.layout());
    grid->addWidget(label, grid->rowCount(), 0, 1, grid->columnCount());
}

}  // namespace

void MarkerTool::showInformation()
{
    const auto marker = table_->selected();
    if (!marker) {
        reading_.say(tr("Choose a marker in the list first"));
        return;
    }
    CaseSession& session = reading_.session();
    QString scan = words(marker->scan_id);
    for (const ScanRecord& record : session.scans())
        if (record.id == marker->scan_id)
            scan = words(positionName(record.series.patient_position));
    auto* box =
        new QMessageBox(QMessageBox::NoIcon, tr("Marker information"),
                        informationOf(*marker, scan, reading_.organWords()), QMessageBox::Close, table_->window());
    box->setObjectName("markerInformation");
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->open();
    connect(&session, &CaseSession::measuresDrawn, box,
            [box, id = words(marker->id)](const QString& of, const Picture& drawn) {
                if (of == id && !box->findChild<QLabel*>("measures"))
                    addMeasures(*box, drawn);
            });
    constexpr int kSide_px = 320;
    session.drawMeasures(*marker, kSide_px);
}

}  // namespace vicon::viewer
