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
}  // namespace

void LookTool::addTo(ReadingLayout& layout)
{
    structure_ = layout.addSwitch(ReadingMenu::view, tr("Cells, gates and what is drawn"), QKeySequence("O"));
    connect(structure_, &QAction::toggled, this, &LookTool::drawAnew);
    addLights(layout);
    occlusion_ = layout.addSwitch(ReadingMenu::view, tr("Light: less between folds (ambient occlusion)"), {});
    occlusion_->setObjectName("ambientOcclusion");
    connect(occlusion_, &QAction::toggled, this, &LookTool::drawAnew);
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
    occlusion_->setChecked(keptSetting(kOcclusion, true).toBool());
}

QVariantMap LookTool::kept() const
{
    return {{kLight, lamp_factor_}, {kOcclusion, occlusion_->isChecked()}};
}

void LookTool::style(EndoscopicRequest& request) const
{
    request.snapshot.ambient_occlusion = occlusion_->isChecked();
    request.structure = structure_->isChecked();
    request.lamp_factor = lamp_factor_;
}

}  // namespace vicon::viewer
