#pragma once

#include "reading/reading_tool.h"

class QAction;
class QActionGroup;

namespace vicon::viewer {

/// How the wall looks: its light, the shade between folds, and the cells and gates behind the picture.
class LookTool : public ReadingTool {
    Q_OBJECT
public:
    using ReadingTool::ReadingTool;

    void addTo(ReadingLayout& layout) override;
    void restore() override;
    QVariantMap kept() const override;
    void style(EndoscopicRequest& request) const override;

private:
    void addLights(ReadingLayout& layout);
    void drawAnew();

    QAction *structure_ = nullptr, *occlusion_ = nullptr;
    QActionGroup* lights_ = nullptr;
    double lamp_factor_ = 1;
};

}  // namespace vicon::viewer
