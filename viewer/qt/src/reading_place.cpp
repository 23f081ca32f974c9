// What a reader finds again when the case is opened the next time: the place in each scan, and how it was looked at.
#include <QAction>
#include <QActionGroup>
#include <QComboBox>
#include <QSplitter>
#include <QTabWidget>
#include <utility>

#include "beside_view.h"
#include "coverage_panel.h"
#include "kept_settings.h"
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
    const QString place = groupOf(session_.record()) + "/";
    QVariantMap values;
    values[place + "scan"] = QString::fromStdString(session_.scan()->record.id);
    values[place + "angle_deg"] = view_angle_deg_;
    values[place + "beside"] = compare_->isChecked();
    values[place + "to_rectum"] = navigator()->heading() == Heading::rectum;
    values[place + "speed_mm_s"] = navigator()->speed_mm_s();
    values[place + "mode"] = int(navigator()->mode());
    values[place + QString::fromStdString(session_.scan()->record.id)] = navigator()->state().station_mm;
    keepSettings(settings_worker_, values);
}

void ReadingWindow::restorePlace(const Arrival& arrival)
{
    const std::shared_ptr<OpenScan> left = std::exchange(left_, {});
    if (left) {
        const OpenScan& scan = *session_.scan();
        navigator()->setHeading(left->navigator.heading());
        navigator()->setSpeed(left->navigator.speed_mm_s());
        if (const auto* other = std::get_if<CorrespondingPlace>(&arrival.place))
            navigator()->jumpTo(corresponding_mm(*left, other->station_mm, scan));
        else if (const auto* same = std::get_if<SamePlace>(&arrival.place))
            navigator()->jumpTo(
                scan.files.skeleton().nearest(same->point_mm.value_or(left->navigator.state().pose.eye_mm)).station_mm);
        return;
    }
    const auto kept = [place = groupOf(session_.record()) + "/"](const QString& key, const QVariant& otherwise = {}) {
        return keptSetting(place + key, otherwise);
    };
    compare_->setChecked(kept("beside").toBool());
    setAngle(kept("angle_deg", view_angle_deg_).toDouble());
    navigator()->setHeading(kept("to_rectum").toBool() ? Heading::rectum : Heading::caecum);
    navigator()->setSpeed(kept("speed_mm_s", navigator()->speed_mm_s()).toDouble());
    navigator()->jumpTo(kept(QString::fromStdString(session_.scan()->record.id), 0).toDouble());
    const int mode = kept("mode").toInt();
    if (mode >= int(NavigationMode::planned) && mode <= int(NavigationMode::free))
        navigator()->setMode(NavigationMode(mode));
}

void ReadingWindow::saveLooks()
{
    QVariantMap values;
    // The screen and the hands are the reader's, whatever the case.
    values["window/geometry"] = saveGeometry();
    values[kColumns] = second_ ? columns_on_one_ : columns_->saveState();
    if (!second_)
        values["window/slices"] = slices_->saveState();
    values["window/two"] = two_screens_->isChecked();
    saveSecondWindow();
    const QString place = groupOf(session_.record()) + "/";
    values[place + "window_level"] = kept_window_.isEmpty() ? window_choice_->currentText() : kept_window_;
    values[place + "peel"] = peeling_->preset();
    values[place + "peel_mm"] = peeling_->offset_mm();
    values[place + "peel_circle"] = peeling_->circleOnly();
    values[place + "light_mm"] = lamp_reach_mm_;
    values[place + "ambient_occlusion"] = occlusion_->isChecked();
    values[place + "paint"] = coverage_->paints();
    values[place + "list"] = lists_->currentIndex();
    keepSettings(settings_worker_, values);
}

void ReadingWindow::restoreLooks()
{
    restoreGeometry(keptSetting("window/geometry").toByteArray());
    columns_->restoreState(keptSetting(kColumns).toByteArray());
    slices_->restoreState(keptSetting("window/slices").toByteArray());
    beside_->hide();  // shown when its scan is there
    two_screens_->setChecked(keptSetting("window/two").toBool());
    const auto kept = [place = groupOf(session_.record()) + "/"](const QString& key, const QVariant& otherwise = {}) {
        return keptSetting(place + key, otherwise);
    };
    kept_window_ = kept("window_level").toString();
    peeling_->choose(kept("peel").toString(), kept("peel_mm").toDouble(), kept("peel_circle").toBool());
    const double reach_mm = kept("light_mm", lamp_reach_mm_).toDouble();
    for (QAction* light : lights_->actions())
        if (light->data().toDouble() == reach_mm) {
            light->setChecked(true);
            lamp_reach_mm_ = reach_mm;
        }
    occlusion_->setChecked(kept("ambient_occlusion").toBool());
    coverage_->setPaints(kept("paint").toBool());
    lists_->setCurrentIndex(kept("list").toInt());
}

}  // namespace vicon::viewer
