#include <QAction>
#include <QActionGroup>
#include <QMenu>
#include <algorithm>

#include "navigation_panel.h"
#include "reading_window.h"

namespace vicon::viewer {
namespace {
constexpr double kNarrowest_deg = 60, kWidest_deg = 120;
constexpr double kNear_mm = 22, kFar_mm = 90;  // half and twice the usual reach of the lamp
}  // namespace

void ReadingWindow::addLooks(QMenu* menu)
{
    structure_ = menu->addAction(tr("Cells, gates and what is drawn"));
    structure_->setCheckable(true);
    structure_->setShortcut(QKeySequence("O"));
    connect(structure_, &QAction::toggled, this, [this] { moved(true); });
    lights_ = new QActionGroup(this);
    for (const auto& [title, reach_mm] :
         {std::pair(tr("Light: near, depth stands out"), kNear_mm), std::pair(tr("Light: usual"), kUsualLampReach_mm),
          std::pair(tr("Light: far"), kFar_mm)}) {
        QAction* action = menu->addAction(title);
        action->setCheckable(true);
        action->setChecked(reach_mm == lamp_reach_mm_);
        action->setData(reach_mm);
        lights_->addAction(action);
        connect(action, &QAction::triggered, this, [this, reach = reach_mm] {
            lamp_reach_mm_ = reach;
            moved(true);
        });
    }
    occlusion_ = menu->addAction(tr("Light: less between folds (ambient occlusion)"));
    occlusion_->setObjectName("ambientOcclusion");
    occlusion_->setCheckable(true);
    connect(occlusion_, &QAction::toggled, this, [this] { moved(true); });
}

void ReadingWindow::setAngle(double angle_deg)
{
    view_angle_deg_ = std::clamp(angle_deg, kNarrowest_deg, kWidest_deg);
    navigation_->setAngle(view_angle_deg_);
    if (session_.scan()) {
        drawEndoscopic(true);
        drawBeside(true);
    }
}

Studio::Wish ReadingWindow::wishFor(const OpenScan& scan, const NavigationState& at, const QSize& size,
                                    bool still) const
{
    Studio::Wish wish;
    wish.request = request(scan, size);
    wish.request.ambient_occlusion = occlusion_->isChecked();
    wish.place = {at.pose, at.station_mm, at.clearance_mm, true};
    wish.still = still;
    wish.paint_seen = paintsSeen();
    wish.structure = structure_->isChecked();
    wish.lamp_reach_mm = lamp_reach_mm_;
    return wish;
}

}  // namespace vicon::viewer
