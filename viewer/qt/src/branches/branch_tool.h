#pragma once

#include "reading/reading_tool.h"
#include "widgets/worker.h"

class QComboBox;

namespace vicon::viewer {

/// The ways through an organ that branches, each from the root to one tip.
class BranchTool : public ReadingTool {
    Q_OBJECT
public:
    explicit BranchTool(Reading& reading);

    void addTo(ReadingLayout& layout) override;
    void scanOpened(const Arrival&) override { showWays(); }
    void scanStays() override { showWays(); }

private:
    void showWays();
    /// @param to where the eye is then; else the place on it that is nearest to where the eye is now
    void takeWay(int tip, std::optional<Point3> to);
    void clickedOverview(Pixel at, Qt::KeyboardModifiers modifiers);

    QComboBox* choice_;
    Worker settings_worker_{this};
};

}  // namespace vicon::viewer
