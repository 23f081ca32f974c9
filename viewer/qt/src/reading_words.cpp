// What the controls call the organ that is read, and the two ends of the way through it.
#include <QAction>
#include <QComboBox>
#include <QSignalBlocker>
#include <QTabWidget>
#include <algorithm>

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
    offerWindows(words.organ);
}

/// The one that was chosen stays where the organ has it too.
void ReadingWindow::offerWindows(const std::string& organ)
{
    const QString wanted = kept_window_.isEmpty() ? window_choice_->currentText() : kept_window_;
    {
        const QSignalBlocker quiet(window_choice_);
        window_choice_->clear();
        for (const WindowLevel& window : windowPresets(organ))
            window_choice_->addItem(QString::fromStdString(window.name));
        window_choice_->setCurrentIndex(std::max(0, window_choice_->findText(wanted)));
    }
    emit window_choice_->currentTextChanged(window_choice_->currentText());
}

void ReadingWindow::showPictureTip()
{
    const bool circle_at_mouse = peeling_->on() && peeling_->circleOnly();  // a tip would lie over what is peeled
    endoscopic_->setToolTip(circle_at_mouse ? QString()
                                            : tr("Click: slices there. Drag: steer. Wheel: on and back. Double click: "
                                                 "enlarge. Shift and click: marker."));
}

}  // namespace vicon::viewer
