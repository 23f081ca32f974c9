// One screen or two: the slices and the organ's projection beside the main view, or in a window of their own.
#include <QGuiApplication>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QScreen>
#include <QVBoxLayout>

#include "reading/reading_views.h"
#include "reading/second_window.h"
#include "widgets/kept_settings.h"

namespace vicon::viewer {
namespace {
constexpr const char* kSecondGeometry = "window/second_geometry";
constexpr const char* kRows = "window/second_rows";
}  // namespace

void ReadingViews::setTwoWindows(bool on)
{
    if (on == twoWindows())
        return;
    if (enlarged_)
        enlarge(enlarged_);
    if (on)
        openSecondWindow();
    else
        closeSecondWindow();
    showViews();
}

void ReadingViews::openSecondWindow()
{
    // Before the window is laid out, its columns are as they were saved.
    columns_in_one_ = isVisible() ? saveState() : keptSetting(sizesKey("columns")).toByteArray();
    second_ = new SecondWindow(window());
    second_->setObjectName("second");
    second_->setWindowTitle(window()->windowTitle());
    second_->addWidget(overview_);
    second_column_->setOrientation(Qt::Horizontal);
    second_->addWidget(second_column_);
    for (const QMenu* of : qobject_cast<QMainWindow*>(window())->menuBar()->findChildren<QMenu*>())
        second_->addActions(of->actions());
    connect(second_, &SecondWindow::closed, this, &ReadingViews::secondWindowClosed);
    connect(second_, &SecondWindow::keyPressed, this, &ReadingViews::keyPressed);
    connect(second_, &SecondWindow::keyReleased, this, &ReadingViews::keyReleased);
    connect(second_, &SecondWindow::left, this, &ReadingViews::keyboardLeft);
    placeSecondWindow();
    second_->show();
}

void ReadingViews::closeSecondWindow()
{
    emit sizesLeft(secondWindowSizes());
    second_column_->setOrientation(Qt::Vertical);
    insertWidget(indexOf(side_), second_column_);
    restoreState(columns_in_one_);
    qobject_cast<QVBoxLayout*>(side_->layout())->insertWidget(0, overview_);
    second_->hide();
    second_->deleteLater();
    second_ = nullptr;
}

/// Where it was, else on the screen that the main window is not on.
void ReadingViews::placeSecondWindow()
{
    if (second_->restoreGeometry(keptSetting(kSecondGeometry).toByteArray())) {
        second_->restoreState(keptSetting(kRows).toByteArray());
        return;
    }
    const QWidget* main = window();
    second_->resize(main->size());
    second_->setSizes(
        {2 * main->height() / 5, 3 * main->height() / 5});  // in a flat strip the projection would be small
    for (const QScreen* other : QGuiApplication::screens())
        if (other != main->screen()) {
            second_->setGeometry(other->availableGeometry());
            return;
        }
}

QVariantMap ReadingViews::secondWindowSizes() const
{
    if (!second_)
        return {};
    return {{kSecondGeometry, second_->saveGeometry()}, {kRows, second_->saveState()}};
}

void ReadingViews::hideSecondWindow()
{
    if (second_)
        second_->hide();
}

}  // namespace vicon::viewer
