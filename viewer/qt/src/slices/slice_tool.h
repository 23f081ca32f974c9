#pragma once

#include <QPointF>
#include <array>

#include "reading/reading_tool.h"
#include "vicon/viewer/model/hanging.h"

class QAction;
class QComboBox;

namespace vicon::viewer {

/// How the slices show densities, what their wheel does, and that they show all of the scan again.
class SliceTool : public ReadingTool {
    Q_OBJECT
public:
    explicit SliceTool(Reading& reading);

    void addTo(ReadingLayout& layout) override;
    void useWords(const OrganWords& words) override;
    /// What is measured is measured as acquired.
    void nextClickChanged() override;

    /// As the reader chose it. The organ may lack the window's name: its default is shown then, or, of a window set by
    /// hand, its numbers.
    const SliceLook& look() const { return wanted_; }
    void setLook(const SliceLook& look);

private:
    static constexpr int kFirstKey = 4, kLastKey = 9;  // 1 to 3 are markers

    void addKeys(ReadingLayout& layout);
    void addCleansed(ReadingLayout& layout);
    void showAcquired();
    void choose(const WindowLevel& window);
    void dragWindow(QPointF by);
    void nextThickness();
    void nextOf();
    void track(Vector3 across, int slices);
    void show();
    WindowLevel presetOf(const QString& name) const;

    QComboBox* window_;  // and level
    QAction *tracks_ = nullptr, *cleansed_ = nullptr;
    std::array<QAction*, kLastKey - kFirstKey + 1> keys_{};  // of the windows in their order
    std::vector<WindowLevel> presets_;
    SliceLook wanted_;
    WindowLevel shown_;
};

}  // namespace vicon::viewer
