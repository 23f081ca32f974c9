#include "looks/look_tool.h"

#include <QAction>
#include <QActionGroup>
#include <utility>

#include "reading/reading.h"
#include "widgets/kept_settings.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
namespace {
constexpr double kNear = 0.5, kUsual = 1, kFar = 2;  // of the usual reach of the lamp
// The reader's own, whatever the case.
constexpr const char* kLight = "look/light";
constexpr const char* kOcclusion = "look/ambient_occlusion";
constexpr const char* kColors = "look/colors";
constexpr const char* kTagging = "look/tagging";
}  // namespace

void LookTool::addTo(ReadingLayout& layout)
{
    structure_ = layout.addSwitch(ReadingMenu::view, tr("Cells, gates and what is drawn"), QKeySequence("O"));
    connect(structure_, &QAction::toggled, this, &LookTool::drawAnew);
    addColors(layout);
    tagging_ = layout.addSwitch(ReadingMenu::view, tr("Wall: blue where tagging touches it"), QKeySequence("Shift+K"));
    tagging_->setObjectName("tagging");
    connect(tagging_, &QAction::toggled, this, &LookTool::drawAnew);
    // Off whenever a case is opened, and not kept: under fluid a flight as acquired shows nothing.
    acquired_ =
        layout.addSwitch(ReadingMenu::view, tr("Wall as acquired (fluid and stool stand)"), QKeySequence("Ctrl+K"));
    acquired_->setObjectName("acquired");
    connect(acquired_, &QAction::toggled, this, &LookTool::drawAnew);
    addLights(layout);
    occlusion_ = layout.addSwitch(ReadingMenu::view, tr("Light: less between folds (ambient occlusion)"), {});
    occlusion_->setObjectName("ambientOcclusion");
    connect(occlusion_, &QAction::toggled, this, &LookTool::drawAnew);
}

void LookTool::addColors(ReadingLayout& layout)
{
    colors_ = new QActionGroup(this);
    for (const auto& [title, colors] :
         {std::pair(tr("Wall: mucosa"), WallColors::mucosa), std::pair(tr("Wall: bone white"), WallColors::bone),
          std::pair(tr("Wall: depth, from warm to blue"), WallColors::depth)}) {
        QAction* action = layout.addSwitch(ReadingMenu::view, title, {});
        action->setChecked(colors == wall_.colors);
        action->setData(QString::fromStdString(nameOf(colors)));
        colors_->addAction(action);
        connect(action, &QAction::triggered, this, [this, colors = colors] {
            wall_.colors = colors;
            drawAnew();
        });
    }
}

void LookTool::addLights(ReadingLayout& layout)
{
    lights_ = new QActionGroup(this);
    for (const auto& [title, factor] : {std::pair(tr("Light: near, depth stands out"), kNear),
                                        std::pair(tr("Light: usual"), kUsual), std::pair(tr("Light: far"), kFar)}) {
        QAction* light = layout.addSwitch(ReadingMenu::view, title, {});
        light->setChecked(factor == lamp_factor_);
        light->setData(factor);
        lights_->addAction(light);
        connect(light, &QAction::triggered, this, [this, factor = factor] {
            lamp_factor_ = factor;
            drawAnew();
        });
    }
}

void LookTool::drawAnew()
{
    reading_.moved(true);
}

void LookTool::restore()
{
    const double factor = keptSetting(kLight, lamp_factor_).toDouble();
    for (QAction* light : lights_->actions())
        if (light->data().toDouble() == factor) {
            light->setChecked(true);
            lamp_factor_ = factor;
        }
    const QVariant colors = keptSetting(kColors, QString::fromStdString(nameOf(wall_.colors)));
    for (QAction* action : colors_->actions())
        if (action->data() == colors) {
            action->setChecked(true);
            wall_.colors = wallColorsFrom(colors.toString().toStdString());
        }
    tagging_->setChecked(keptSetting(kTagging, true).toBool());  // what tagging may hide is no secret
    occlusion_->setChecked(keptSetting(kOcclusion, true).toBool());
}

void LookTool::scanOpened(const Arrival&)
{
    const bool has_densities = reading_.scan()->files.quantity() == Quantity::density;
    acquired_->setEnabled(has_densities);
    if (!has_densities)
        acquired_->setChecked(false);
}

QVariantMap LookTool::kept() const
{
    return {{kLight, lamp_factor_},
            {kOcclusion, occlusion_->isChecked()},
            {kColors, QString::fromStdString(nameOf(wall_.colors))},
            {kTagging, tagging_->isChecked()}};
}

void LookTool::style(EndoscopicRequest& request) const
{
    request.snapshot.wall = {wall_.colors, occlusion_->isChecked(), tagging_->isChecked(), acquired_->isChecked()};
    request.structure = structure_->isChecked();
    request.lamp_factor = lamp_factor_;
}

}  // namespace vicon::viewer
