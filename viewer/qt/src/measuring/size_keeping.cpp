// Where a size goes that was measured: to its marker, or to the one beside it.
#include <QMessageBox>
#include <QPushButton>

#include "measuring/measuring_tool.h"
#include "reading/reading.h"
#include "widgets/length_text.h"

namespace vicon::viewer {

void MeasuringTool::take(const Shown& result)
{
    if (!shown_ || shown_->request == result.request) {
        const auto dragged_mm = shown_ ? shown_->dragged_mm : std::vector<Point3>();
        shown_ = result;
        shown_->dragged_mm = dragged_mm;  // an end that is held by now stays with the mouse
    }
    showLine();
    offer(result);
}

void MeasuringTool::offer(const Shown& result)
{
    if (reading_.session().busy()) {
        waiting_.push_back(result);
        return;
    }
    if (!result.marker_id.empty()) {
        keep(result.marker_id, result);
        return;
    }
    const auto marker =
        reading_.markerNear(result.scan_id, [&](Point3 place) { return outsideOf_mm(result.size, place); });
    const auto scan = reading_.session().openScan(result.scan_id);
    if (scan && scan->record.case_id != reading_.session().record().id)
        reading_.say(sizeText(result.size) + tr("; not kept: the earlier examination takes no markers"));
    else if (!marker)
        reading_.say(sizeText(result.size) + tr("; no marker beside it to keep it with"));
    else if (marker->size)
        ask(*marker, result);
    else
        keep(marker->id, result);
}

void MeasuringTool::ask(const Marker& marker, const Shown& result)
{
    const QString id = QString::fromStdString(marker.id);
    auto* box = new QMessageBox(
        QMessageBox::Question, tr("Replace the size?"),
        tr("%1 has a size already: %2.\n\nThe new one: %3.").arg(id, sizeText(*marker.size), sizeText(result.size)),
        QMessageBox::NoButton, reading_.views().window());
    box->setObjectName("replaceSize");
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->addButton(tr("&Replace it"), QMessageBox::AcceptRole)->setObjectName("replace");
    auto* leave = box->addButton(tr("&Keep the old one"), QMessageBox::RejectRole);
    leave->setObjectName("keepOld");
    box->setDefaultButton(leave);
    box->setEscapeButton(leave);
    connect(box, &QMessageBox::accepted, this, [this, marker_id = marker.id, result] { keep(marker_id, result); });
    connect(box, &QMessageBox::rejected, this, [this, id, marker_id = marker.id, request = result.request] {
        const auto kept = reading_.session().marker(marker_id);
        if (kept && shown_ && shown_->request == request)
            markerShown(*kept);
        reading_.say(tr("%1 keeps its size").arg(id));
    });
    box->open();
}

void MeasuringTool::keep(const std::string& marker_id, const Shown& result)
{
    const QString id = QString::fromStdString(marker_id);
    const auto marker = reading_.session().marker(marker_id);
    if (!marker) {
        reading_.warn(tr("%1 was deleted before its size was there: %2.").arg(id, sizeText(result.size)));
        return;
    }
    if (shown_ && shown_->request == result.request)
        shown_->marker_id = marker_id;
    Marker after = *marker;
    after.size = result.size;
    reading_.session().changeMarker(*marker, after, false, tr("%1; kept with %2").arg(sizeText(result.size), id));
}

}  // namespace vicon::viewer
