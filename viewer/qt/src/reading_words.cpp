// What the controls call the organ that is read, and the two ends of the way through it.
#include <QAction>
#include <QTabWidget>

#include "colon_panel.h"
#include "coverage_panel.h"
#include "reading_window.h"

namespace vicon::viewer {

void ReadingWindow::useWords(const OrganWords& words)
{
    const QString organ = QString::fromStdString(words.organ), first = QString::fromStdString(words.first_end);
    to_first_end_->setText(tr("To the %1").arg(first));
    to_last_end_->setText(tr("To the %1").arg(QString::fromStdString(words.last_end)));
    overview_->setAccessibleName(tr("Projection of the %1").arg(organ));
    const QString along = tr("Distance from the %1 along the %2").arg(first, organ);
    table_->setStationTip(along);
    coverage_->setStationTip(along);
    const int colon = lists_->indexOf(colon_);
    lists_->setTabEnabled(colon, words.isColon());
    lists_->setTabToolTip(colon, words.isColon()
                                     ? tr("Bridges over collapsed parts, and corrections of the lumen")
                                     : tr("Bridges and corrections are a colon's; this scan shows the %1").arg(organ));
}

void ReadingWindow::showPictureTip()
{
    const bool circle_at_mouse = peeling_->on() && peeling_->circleOnly();  // a tip would lie over what is peeled
    endoscopic_->setToolTip(circle_at_mouse ? QString()
                                            : tr("Click: slices there. Drag: steer. Wheel: on and back. Double click: "
                                                 "enlarge. Shift and click: marker."));
}

}  // namespace vicon::viewer
