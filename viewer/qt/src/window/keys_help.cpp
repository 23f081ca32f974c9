#include "window/keys_help.h"

#include <QAction>
#include <QDialog>
#include <QDialogButtonBox>
#include <QLabel>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QVBoxLayout>
#include <algorithm>
#include <vector>

namespace vicon::viewer {
namespace {

constexpr int kKeyColumns = 4;  // of a screen 1366 pixels wide

struct Key {
    QString key, what;
};

struct Group {
    QString title;
    std::vector<Key> keys;

    /// With its title, and the line above it that keeps it from the group before.
    int lines() const { return int(keys.size()) + 2; }
};

QString translated(const char* text)
{
    return QObject::tr(text);
}

/// A group for each menu, and what no menu has.
std::vector<Group> groupsOf(const QMainWindow& window)
{
    std::vector<Group> groups;
    for (const QMenu* menu : window.menuBar()->findChildren<QMenu*>()) {
        groups.push_back({menu->title().remove('&'), {}});
        for (const QAction* action : menu->actions())
            if (!action->shortcut().isEmpty())
                groups.back().keys.push_back({action->shortcut().toString(), action->text().remove('&')});
    }
    groups.push_back({translated("In a view"),
                      {{translated("W A S D"), translated("Guided and free: on, left, back, right")},
                       {translated("arrows"), translated("Guided and free: turn the view")},
                       {translated("arrows, Return"), translated("A click is awaited: move the cross, click")},
                       {translated("Shift+Return"), translated("Red marker in the middle or at the mouse")},
                       {translated("Tab, Shift+Tab"), translated("Next, previous view or control")},
                       {translated("PgUp, PgDown"), translated("Slices (Ctrl: zoom; Ctrl+arrows: pan)")}}});
    return groups;
}

/// Groups in their order, none divided, in columns of which none has more than `most` lines.
std::vector<std::vector<Group>> columnsOf(const std::vector<Group>& groups, int most)
{
    std::vector<std::vector<Group>> columns;
    int lines = 0;
    for (const Group& group : groups) {
        if (columns.empty() || lines + group.lines() > most) {
            columns.emplace_back();
            lines = 0;
        }
        columns.back().push_back(group);
        lines += group.lines();
    }
    return columns;
}

/// As low as so many columns make it.
std::vector<std::vector<Group>> columnsOf(const std::vector<Group>& groups)
{
    int most = 0;
    for (const Group& group : groups)
        most = std::max(most, group.lines());
    while (columnsOf(groups, most).size() > kKeyColumns)
        ++most;
    return columnsOf(groups, most);
}

QString tableOf(const std::vector<Group>& column)
{
    const auto unbroken = [](const QString& words) { return words.toHtmlEscaped().replace(' ', "&nbsp;"); };
    QString text = "<table cellspacing='0'>";  // more lines fit on a low screen
    for (const Group& group : column) {
        if (&group != &column.front())
            text += "<tr><td>&nbsp;</td></tr>";
        text += QString("<tr><td colspan='2'><u>%1</u></td></tr>").arg(unbroken(group.title));
        for (const Key& key : group.keys)
            text += QString("<tr><td><b>%1</b></td><td>&nbsp;&nbsp;%2</td></tr>")
                        .arg(unbroken(key.key), unbroken(key.what));
    }
    return text + "</table>";
}

QString pageOf(const std::vector<Group>& groups)
{
    QString text = "<table cellspacing='0'><tr>";
    for (const std::vector<Group>& column : columnsOf(groups))
        text += "<td>" + tableOf(column) + "</td><td>&nbsp;&nbsp;&nbsp;&nbsp;</td>";
    return text + "</tr></table>";
}

}  // namespace

// A message box would be no wider than a thousand pixels.
void showKeys(QMainWindow& window)
{
    auto* dialog = new QDialog(&window);
    dialog->setObjectName("keys");
    dialog->setWindowTitle(translated("Keys"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    auto* text = new QLabel(pageOf(groupsOf(window)), dialog);
    text->setObjectName("keysText");
    auto* close = new QDialogButtonBox(QDialogButtonBox::Close, dialog);
    QObject::connect(close, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
    auto* layout = new QVBoxLayout(dialog);
    layout->addWidget(text);
    layout->addWidget(close);
    dialog->open();
}

}  // namespace vicon::viewer
