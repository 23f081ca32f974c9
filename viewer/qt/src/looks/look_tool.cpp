#include "looks/look_tool.h"

#include <QAction>
#include <QActionGroup>
#include <utility>

#include "reading/kept_place.h"
#include "reading/reading.h"
#include "widgets/kept_settings.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
namespace {
constexpr double kNear_mm = 22, kFar_mm = 90;  // half and twice the usual reach of the lamp
constexpr const char* kLight = "light_mm";
constexpr const char* kOcclusion = "ambient_occlusion";
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
    for (const auto& [title, reach_mm] :
         {std::pair(tr("Light: near, depth stands out"), kNear_mm), std::pair(tr("Light: usual"), kUsualLampReach_mm),
          std::pair(tr("Light: far"), kFar_mm)}) {
        QAction* light = layout.addSwitch(ReadingMenu::view, title, {});
        light->setChecked(reach_mm == lamp_reach_mm_);
        light->setData(reach_mm);
        lights_->addAction(light);
        connect(light, &QAction::triggered, this, [this, reach = reach_mm] {
            lamp_reach_mm_ = reach;
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
    const CaseRecord& record = reading_.session().record();
    const double reach_mm = keptSetting(keptKey(record, kLight), lamp_reach_mm_).toDouble();
    for (QAction* light : lights_->actions())
        if (light->data().toDouble() == reach_mm) {
            light->setChecked(true);
            lamp_reach_mm_ = reach_mm;
        }
    occlusion_->setChecked(keptSetting(keptKey(record, kOcclusion)).toBool());
}

QVariantMap LookTool::kept() const
{
    const CaseRecord& record = reading_.session().record();
    return {{keptKey(record, kLight), lamp_reach_mm_}, {keptKey(record, kOcclusion), occlusion_->isChecked()}};
}

void LookTool::style(EndoscopicRequest& request) const
{
    request.snapshot.ambient_occlusion = occlusion_->isChecked();
    request.structure = structure_->isChecked();
    request.lamp_reach_mm = lamp_reach_mm_;
}

}  // namespace vicon::viewer
