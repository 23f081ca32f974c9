// One screen or two: the slices and the colon's projection beside the main view, or in a window of their own.
#include <QAction>
#include <QGuiApplication>
#include <QMenu>
#include <QMenuBar>
#include <QScreen>
#include <QVBoxLayout>

#include "kept_settings.h"
#include "reading_window.h"
#include "second_window.h"

namespace vicon::viewer {
namespace {
constexpr const char* kGeometry = "window/second_geometry";
constexpr const char* kRows = "window/second_rows";
constexpr int kSlicesColumn = 2;
}  // namespace

void ReadingWindow::addScreens(QMenu* menu)
{
    two_screens_ = menu->addAction(tr("Slices and projection in a second window"));
    two_screens_->setCheckable(true);
    two_screens_->setShortcut(QKeySequence("F2"));
    connect(two_screens_, &QAction::toggled, this, &ReadingWindow::setTwoScreens);
}

void ReadingWindow::setTwoScreens(bool on)
{
    if (on == (second_ != nullptr))
        return;
    if (enlarged_)
        enlarge(enlarged_);
    if (!on) {
        saveSecondWindow();
        slices_->setOrientation(Qt::Vertical);
        columns_->insertWidget(kSlicesColumn, slices_);
        columns_->restoreState(columns_on_one_);
        qobject_cast<QVBoxLayout*>(side_->layout())->insertWidget(0, overview_);
        second_->hide();
        second_->deleteLater();
        second_ = nullptr;
        return;
    }
    // Before the window is laid out, its columns are as they were saved.
    columns_on_one_ = isVisible() ? columns_->saveState() : keptSetting(kColumns).toByteArray();
    second_ = new SecondWindow(this);
    second_->setObjectName("second");
    second_->setWindowTitle(windowTitle());
    second_->addWidget(overview_);
    slices_->setOrientation(Qt::Horizontal);
    second_->addWidget(slices_);
    for (const QMenu* of : menuBar()->findChildren<QMenu*>())
        second_->addActions(of->actions());
    connect(second_, &SecondWindow::closed, this, [this] { two_screens_->setChecked(false); });
    connect(second_, &SecondWindow::keyPressed, this, &ReadingWindow::keyPressEvent);
    connect(second_, &SecondWindow::keyReleased, this, &ReadingWindow::keyReleaseEvent);
    connect(second_, &SecondWindow::left, this, [this] {
        keys_.clear();
        updateSteering();
    });
    placeSecondWindow();
    second_->show();
}

/// Where it was, else on the screen that the main window is not on.
void ReadingWindow::placeSecondWindow()
{
    if (second_->restoreGeometry(keptSetting(kGeometry).toByteArray())) {
        second_->restoreState(keptSetting(kRows).toByteArray());
        return;
    }
    second_->resize(size());
    second_->setSizes({2 * height() / 5, 3 * height() / 5});  // in a flat strip the projection would be small
    for (const QScreen* other : QGuiApplication::screens())
        if (other != screen()) {
            second_->setGeometry(other->availableGeometry());
            return;
        }
}

void ReadingWindow::saveSecondWindow()
{
    if (second_)
        keepSettings(settings_worker_, {{kGeometry, second_->saveGeometry()}, {kRows, second_->saveState()}});
}

}  // namespace vicon::viewer
