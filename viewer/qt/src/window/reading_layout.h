#pragma once

#include <QKeySequence>
#include <QLabel>
#include <QMainWindow>
#include <functional>
#include <vector>

#include "reading/reading_views.h"

class QAction;
class QDockWidget;
class QHBoxLayout;
class QMenu;
class QTabWidget;
class QVBoxLayout;

namespace vicon::viewer {

class ControlsArea;
class PictureView;

enum class ReadingMenu { a_case, edit, flight, view, slices, help };

/// Where things lie in the reading window: a line of choices above the views, the views, beside them the controls, a
/// tab for each list, the menus, the status line. Tools put their own things there.
class ReadingLayout : public QObject {
    Q_OBJECT
public:
    enum class PanelPlace { above_lists, below_lists };

    /// Fills the window.
    ReadingLayout(QMainWindow& window, ReadingViews& views);

    /// Above the views.
    void addChoice(QWidget* choice);
    /// Beside the choices: whose the pictures are.
    /// @param more what there is no room for: the banner's tooltip
    void showBanner(const QString& words, const QString& more);
    /// Among the controls.
    void addPanel(QWidget* panel, PanelPlace place);
    /// It has one table, which Return and the arrow keys act on.
    void addList(QWidget* list, const QString& title);
    void addStatus(QWidget* status);
    /// Beside or below views and controls, hidden until it is shown; it can be taken out into a window of its own.
    QDockWidget* addForm(QWidget* form, const QString& title, Qt::DockWidgetArea area = Qt::RightDockWidgetArea);
    QAction* addAction(ReadingMenu menu, const QString& title, const QKeySequence& key, std::function<void()> what);
    /// @param key may be empty
    QAction* addSwitch(ReadingMenu menu, const QString& title, const QKeySequence& key);

    /// Everything is there: the order of Tab, and whose a key is.
    void finish();

    void say(const QString& message);
    void warn(const QString& message);
    /// Beside the warning: what is to be known about the place.
    void notice(const QString& message);
    void showList(QWidget* list);
    void enableList(QWidget* list, bool on, const QString& tip);
    /// The keyboard goes to the list that is shown; to the next one, where it is there already.
    void goToList();
    int shownList() const;
    void showList(int which);

signals:
    void listShown(QWidget* list);

private:
    QWidget* buildTop();
    QWidget* buildControls();
    QMenu* menuOf(ReadingMenu menu);
    void showMenuIn(const PictureView& view, QPoint at);
    void showNextList();
    void orderTabs();

    QMainWindow& window_;
    ReadingViews& views_;
    QHBoxLayout* top_;
    QVBoxLayout* controls_;
    ControlsArea* area_;
    QTabWidget* lists_;
    QLabel *banner_, *notice_, *warning_;
    std::vector<QMenu*> menus_;
    std::vector<QWidget*> choices_, above_, below_, status_;
    std::vector<QDockWidget*> beside_;  // forms that stand beside the views
};

}  // namespace vicon::viewer
