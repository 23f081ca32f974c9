// A reading without a mouse: where Tab leads, who has the keyboard, and the list of keys.
#include <QAction>
#include <QComboBox>
#include <QMenuBar>
#include <QMessageBox>
#include <QTabBar>
#include <QTabWidget>
#include <QTableWidget>

#include "beside_view.h"
#include "colon_panel.h"
#include "coverage_panel.h"
#include "film_maker.h"
#include "panel_parts.h"
#include "reading_window.h"
#include "second_window.h"

namespace vicon::viewer {

// From left to right and from top to bottom, as the eye goes.
void ReadingWindow::orderTabs()
{
    std::vector<QWidget*> order{scan_choice_,     way_choice_, window_choice_, endoscopic_, beside_->endoscopic(),
                                beside_->slice(), transverse_, coronal_,       sagittal_,   overview_};
    const auto add = [&](std::initializer_list<QWidget*> parts) {
        for (QWidget* part : parts)
            for (QWidget* control : reachableIn(part))
                order.push_back(control);
    };
    add({navigation_});
    order.push_back(lists_);
    add({table_, coverage_, colon_, peeling_, opening_, film_maker_});
    for (std::size_t n = 1; n < order.size(); ++n)
        setTabOrder(order[n - 1], order[n]);
}

void ReadingWindow::notAfterAll()
{
    endoscopic_->setFocus(Qt::ShortcutFocusReason);
    navigation_->forgetStation();
    if (second_)
        second_->setFocus(Qt::ShortcutFocusReason);
    endTool();
    measured_way_.clear();
    drawMeasured();
    warn({});
}

void ReadingWindow::goToList()
{
    auto* list = lists_->currentWidget()->findChild<QTableWidget*>();
    if (list->rowCount() > 0 && list->selectionModel()->selectedRows().empty())
        list->selectRow(0);
    list->setFocus(Qt::ShortcutFocusReason);
}

void ReadingWindow::enlargeFocused()
{
    for (QWidget* slice : std::initializer_list<QWidget*>{transverse_, coronal_, sagittal_})
        if (slice->hasFocus()) {
            enlarge(slice);
            return;
        }
    enlarge(enlarged_ ? enlarged_ : endoscopic_);
}

void ReadingWindow::showKeys()
{
    QVector<QPair<QString, QString>> keys;
    for (const QMenu* menu : menuBar()->findChildren<QMenu*>())
        for (const QAction* action : menu->actions())
            if (!action->shortcut().isEmpty())
                keys.append({action->shortcut().toString(), action->text()});
    keys.append({tr("W A S D"), tr("Guided and free: on, left, back, right")});
    keys.append({tr("arrows"), tr("Guided and free: turn the view")});
    keys.append({tr("arrows, Return"), tr("Where a click is awaited: move the cross (Shift: finely), click")});
    keys.append({tr("Shift+Return"), tr("Red marker in the middle or at the mouse")});
    keys.append(
        {tr("Tab, Shift+Tab"), tr("To the next view or control, to the one before; Space or Return presses it")});
    keys.append({tr("PgUp, PgDown"), tr("In a slice reached by Tab: scroll (Ctrl: zoom; Ctrl and arrows: pan)")});
    // In two columns, for a screen of large letters is soon too low for one.
    const int rows = (keys.size() + 1) / 2;
    const auto unbroken = [](const QString& words) { return words.toHtmlEscaped().replace(' ', "&nbsp;"); };
    QString text = "<table>";
    for (int row = 0; row < rows; ++row) {
        text += "<tr>";
        for (int n = row; n < keys.size(); n += rows)
            text += QString("<td><b>%1</b>&nbsp;&nbsp;</td><td>%2&nbsp;&nbsp;&nbsp;</td>")
                        .arg(unbroken(keys[n].first), unbroken(keys[n].second));
        text += "</tr>";
    }
    auto* box = new QMessageBox(QMessageBox::NoIcon, tr("Keys"), text + "</table>", QMessageBox::Close, this);
    box->setObjectName("keys");
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->open();
}

}  // namespace vicon::viewer
