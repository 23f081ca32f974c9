#pragma once

#include "reading/reading_tool.h"

class QAction;
class QActionGroup;

namespace vicon::viewer {

/// How the wall looks: its colours, the tint of tagging, its light, the shade between folds, and the cells and gates
/// behind the picture.
class LookTool : public ReadingTool {
    Q_OBJECT
public:
    using ReadingTool::ReadingTool;

    void addTo(ReadingLayout& layout) override;
    void restore() override;
    void scanOpened(const Arrival&) override;
    QVariantMap kept() const override;
    void style(EndoscopicRequest& request) const override;

private:
    void addColors(ReadingLayout& layout);
    void addLights(ReadingLayout& layout);
    void drawAnew();

    QAction *structure_ = nullptr, *tagging_ = nullptr, *acquired_ = nullptr, *occlusion_ = nullptr;
    QActionGroup *colors_ = nullptr, *lights_ = nullptr;
    WallLook wall_;
    double lamp_factor_ = 1;
};

}  // namespace vicon::viewer
