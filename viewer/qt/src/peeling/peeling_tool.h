#pragma once

#include "reading/reading_tool.h"

namespace vicon::viewer {

class PeelingPanel;

/// The look below the wall, everywhere or in a circle around the mouse.
class PeelingTool : public ReadingTool {
    Q_OBJECT
public:
    explicit PeelingTool(Reading& reading);

    PeelingPanel& panel() const { return *panel_; }

    void addTo(ReadingLayout& layout) override;
    void restore() override;
    void scanOpened(const Arrival&) override;
    QVariantMap kept() const override;
    void complete(EndoscopicRequest& request) const override;

private:
    void showTip();
    void drawSoon();

    PeelingPanel* panel_;
    std::optional<Pixel> mouse_at_;  // where it was last
};

}  // namespace vicon::viewer
