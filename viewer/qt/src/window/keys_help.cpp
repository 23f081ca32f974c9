#include "window/keys_help.h"

#include <QAction>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QPair>
#include <QVector>

namespace vicon::viewer {
namespace {

using Keys = QVector<QPair<QString, QString>>;

QString tr(const char* text)
{
    return QObject::tr(text);
}

Keys keysOf(const QMainWindow& window)
{
    Keys keys;
    for (const QMenu* menu : window.menuBar()->findChildren<QMenu*>())
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
    return keys;
}

/// In two columns, for a screen of large letters is soon too low for one.
QString tableOf(const Keys& keys)
{
    const int rows = (keys.size() + 1) / 2;
    const auto unbroken = [](const QString& words) { return words.toHtmlEscaped().replace(' ', "&nbsp;"); };
    QString text = "<table cellspacing='0'>";  // more lines fit on a low screen
    for (int row = 0; row < rows; ++row) {
        text += "<tr>";
        for (int n = row; n < keys.size(); n += rows)
            text += QString("<td><b>%1</b>&nbsp;&nbsp;</td><td>%2&nbsp;&nbsp;&nbsp;</td>")
                        .arg(unbroken(keys[n].first), unbroken(keys[n].second));
        text += "</tr>";
    }
    return text + "</table>";
}

}  // namespace

void showKeys(QMainWindow& window)
{
    auto* box = new QMessageBox(QMessageBox::NoIcon, tr("Keys"), tableOf(keysOf(window)), QMessageBox::Close, &window);
    box->setObjectName("keys");
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->open();
}

}  // namespace vicon::viewer
