#include <QFileDialog>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QStatusBar>

#include "film_maker.h"
#include "reading_window.h"

namespace vicon::viewer {
namespace {

QString row(const QString& name, const QString& value)
{
    if (value.isEmpty())
        return {};
    return QString("<tr><td><b>%1</b>&nbsp;&nbsp;</td><td>%2</td></tr>")
        .arg(name.toHtmlEscaped(), value.toHtmlEscaped());
}

QString mm(double value)
{
    return QString::number(value, 'f', 1) + " mm";
}

QString words(const std::string& utf8)
{
    return QString::fromStdString(utf8);
}

QString sizeWords(const Marker& marker)
{
    if (!marker.size)
        return {};
    QString text = QObject::tr("%1 straight").arg(mm(marker.size->straight_mm));
    if (marker.size->along_mm)
        text += QObject::tr(", %1 along the wall").arg(mm(*marker.size->along_mm));
    if (marker.size->plane)
        text += QObject::tr(", %1 largest in the best plane").arg(mm(marker.size->plane->diameter_mm));
    return text;
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
        .arg(mm(sample.radius_mm));
}

QString informationOf(const Marker& marker, const QString& scan, const OrganWords& organ)
{
    const Point3 p = marker.position_mm;
    return "<table>" + row(QObject::tr("Marker"), words(marker.id + ", " + nameOf(marker.color))) +
           row(QObject::tr("Scan"), scan) +
           row(QObject::tr("Part"), marker.part ? words(nameOf(*marker.part)) : QString()) +
           row(QObject::tr("From the %1").arg(words(organ.first_end)), mm(marker.station_mm)) +
           row(QObject::tr("From the %1").arg(words(organ.last_end)), mm(marker.from_caecum_mm)) +
           row(QObject::tr("LPS"),
               QObject::tr("%1, %2, %3 mm").arg(p.x, 0, 'f', 1).arg(p.y, 0, 'f', 1).arg(p.z, 0, 'f', 1)) +
           row(QObject::tr("Size"), sizeWords(marker)) + row(QObject::tr("Density"), densityWords(marker)) +
           row(QObject::tr("Same finding"), words(marker.pair)) + row(QObject::tr("Note"), words(marker.note)) +
           row(QObject::tr("Placed"), words(marker.created)) + row(QObject::tr("Changed"), words(marker.changed)) +
           "</table>";
}

}  // namespace

void ReadingWindow::chooseMarkerFile(bool to_save)
{
    auto* dialog = new QFileDialog(this, to_save ? tr("Save markers") : tr("Load markers"));
    dialog->setObjectName(to_save ? "saveMarkers" : "loadMarkers");
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setOption(QFileDialog::DontUseNativeDialog);
    dialog->setAcceptMode(to_save ? QFileDialog::AcceptSave : QFileDialog::AcceptOpen);
    dialog->setFileMode(to_save ? QFileDialog::AnyFile : QFileDialog::ExistingFile);
    dialog->setNameFilter(tr("Markers (*.json)"));
    dialog->setDefaultSuffix("json");
    // Its list of completions lies over the buttons, and takes the first click on them.
    dialog->findChild<QLineEdit*>("fileNameEdit")->setCompleter(nullptr);
    connect(dialog, &QFileDialog::fileSelected, this, [this, to_save](const QString& file) {
        if (to_save)
            session_.saveMarkers(file.toStdString());
        else
            session_.loadMarkers(file.toStdString());
    });
    dialog->open();
}

void ReadingWindow::showMarkerInformation()
{
    const auto marker = table_->selected();
    if (!marker) {
        tell(tr("Choose a marker in the list first"));
        return;
    }
    QString scan = words(marker->scan_id);
    for (const ScanRecord& record : session_.scans())
        if (record.id == marker->scan_id)
            scan = words(positionName(record.series.patient_position));
    auto* box = new QMessageBox(QMessageBox::NoIcon, tr("Marker information"),
                                informationOf(*marker, scan, organWords()), QMessageBox::Close, this);
    box->setObjectName("markerInformation");
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->open();
    const QString id = words(marker->id);
    connect(&session_, &CaseSession::measuresDrawn, box, [box, id](const QString& of, const Picture& drawn) {
        if (of != id || box->findChild<QLabel*>("measures"))
            return;
        const QImage image(drawn.rgb.data(), drawn.width, drawn.height, 3 * drawn.width, QImage::Format_RGB888);
        auto* label = new QLabel(box);
        label->setObjectName("measures");
        label->setAccessibleName(tr("Best plane and densities"));
        label->setPixmap(QPixmap::fromImage(image));
        auto* grid = qobject_cast<QGridLayout*>(box->layout());
        grid->addWidget(label, grid->rowCount(), 0, 1, grid->columnCount());
    });
    constexpr int kSide_px = 320;
    session_.drawMeasures(*marker, kSide_px);
}

void ReadingWindow::connectFilm()
{
    film_maker_ = new FilmMaker(studio_, this);
    statusBar()->addPermanentWidget(film_maker_);
    film_maker_->hide();
    connect(film_maker_, &FilmMaker::finished, this,
            [this](const QString& file) { tell(tr("Film saved: %1").arg(file)); });
    connect(film_maker_, &FilmMaker::cancelled, this,
            [this] { tell(tr("The film was cancelled; nothing is kept of it.")); });
    connect(&session_, &CaseSession::filmNamed, this, [this](const QString& file) {
        if (!navigator())
            return;
        constexpr int kLargest_px = 768;
        const QSize view = endoscopic_->pictureSize().boundedTo({kLargest_px, kLargest_px});
        const QSize size(view.width() / 2 * 2, view.height() / 2 * 2);  // Theora's colours have half the pixels
        const NavigationState from = navigator()->state();
        const double step_mm = navigator()->speed_mm_s() / FilmMaker::kPictures_per_s;
        film_maker_->start(session_.sharedScan(), wishFor(*session_.scan(), from, size, false), from.station_mm,
                           navigator()->heading(), step_mm, file.toStdString());
    });
}

void ReadingWindow::film()
{
    if (!navigator())
        return;
    if (film_maker_->running()) {
        film_maker_->cancel();
        return;
    }
    tell(tr("Filming the way from here to the end; you can read on meanwhile"));
    session_.nameFilm();
}

}  // namespace vicon::viewer
