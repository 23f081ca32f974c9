// What a reader finds again when the case is opened the next time: the place in each scan, and how it was looked at.
#include <QAction>
#include <QActionGroup>
#include <QComboBox>
#include <QSettings>
#include <QSplitter>
#include <QTabWidget>

#include "beside_view.h"
#include "coverage_panel.h"
#include "reading_window.h"

namespace vicon::viewer {
namespace {

QString groupOf(const CaseRecord& record)
{
    return "place/" + QString::fromStdString(record.id);
}

}  // namespace

void ReadingWindow::savePlace()
{
    if (!navigator())
        return;
    QSettings settings;
    settings.beginGroup(groupOf(session_.record()));
    settings.setValue("scan", QString::fromStdString(session_.scan()->record.id));
    settings.setValue("angle_deg", view_angle_deg_);
    settings.setValue("beside", compare_->isChecked());
    settings.setValue("to_rectum", navigator()->heading() == Heading::rectum);
    settings.setValue("speed_mm_s", navigator()->speed_mm_s());
    settings.setValue("mode", int(navigator()->mode()));
    settings.setValue(QString::fromStdString(session_.scan()->record.id), navigator()->state().station_mm);
}

void ReadingWindow::restorePlace()
{
    if (came_from_) {
        navigator()->setHeading(came_from_->navigator.heading());
        navigator()->setSpeed(came_from_->navigator.speed_mm_s());
        const bool same = came_from_->record.id == session_.scan()->record.id;  // done again: where the eye was
        const Point3 eye = came_from_->navigator.state().pose.eye_mm;
        navigator()->jumpTo(same ? session_.scan()->files.skeleton().nearest(eye).station_mm
                                 : corresponding_mm(*came_from_, came_from_mm_, *session_.scan()));
        came_from_.reset();
        return;
    }
    QSettings settings;
    settings.beginGroup(groupOf(session_.record()));
    compare_->setChecked(settings.value("beside").toBool());
    setAngle(settings.value("angle_deg", view_angle_deg_).toDouble());
    navigator()->setHeading(settings.value("to_rectum").toBool() ? Heading::rectum : Heading::caecum);
    navigator()->setSpeed(settings.value("speed_mm_s", navigator()->speed_mm_s()).toDouble());
    navigator()->jumpTo(settings.value(QString::fromStdString(session_.scan()->record.id), 0).toDouble());
    const int mode = settings.value("mode").toInt();
    if (mode >= int(NavigationMode::planned) && mode <= int(NavigationMode::free))
        navigator()->setMode(NavigationMode(mode));
}

void ReadingWindow::saveLooks()
{
    QSettings settings;
    // The screen and the hands are the reader's, whatever the case.
    settings.setValue("window/geometry", saveGeometry());
    if (!second_) {
        settings.setValue("window/columns", columns_->saveState());
        settings.setValue("window/slices", slices_->saveState());
    }
    settings.setValue("window/two", two_screens_->isChecked());
    saveSecondWindow();
    settings.beginGroup(groupOf(session_.record()));
    settings.setValue("window_level", window_choice_->currentText());
    settings.setValue("peel", peeling_->preset());
    settings.setValue("peel_mm", peeling_->offset_mm());
    settings.setValue("peel_circle", peeling_->circleOnly());
    settings.setValue("light_mm", lamp_reach_mm_);
    settings.setValue("ambient_occlusion", occlusion_->isChecked());
    settings.setValue("paint", coverage_->paints());
    settings.setValue("list", lists_->currentIndex());
}

void ReadingWindow::restoreLooks()
{
    QSettings settings;
    restoreGeometry(settings.value("window/geometry").toByteArray());
    columns_->restoreState(settings.value("window/columns").toByteArray());
    slices_->restoreState(settings.value("window/slices").toByteArray());
    beside_->hide();  // shown when its scan is there
    two_screens_->setChecked(settings.value("window/two").toBool());
    settings.beginGroup(groupOf(session_.record()));
    const int level = window_choice_->findText(settings.value("window_level").toString());
    if (level >= 0)
        window_choice_->setCurrentIndex(level);
    peeling_->choose(settings.value("peel").toString(), settings.value("peel_mm").toDouble(),
                     settings.value("peel_circle").toBool());
    const double reach_mm = settings.value("light_mm", lamp_reach_mm_).toDouble();
    for (QAction* light : lights_->actions())
        if (light->data().toDouble() == reach_mm) {
            light->setChecked(true);
            lamp_reach_mm_ = reach_mm;
        }
    occlusion_->setChecked(settings.value("ambient_occlusion").toBool());
    coverage_->setPaints(settings.value("paint").toBool());
    lists_->setCurrentIndex(settings.value("list").toInt());
}

}  // namespace vicon::viewer
