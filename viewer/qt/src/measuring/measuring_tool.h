#pragma once

#include <vector>

#include "reading/reading_tool.h"
#include "vicon/viewer/model/plane_size.h"
#include "vicon/viewer/model/wall_distance.h"

namespace vicon::viewer {

/// The size of a finding between two clicks, along the wall or straight; kept with the marker beside it.
class MeasuringTool : public ReadingTool {
    Q_OBJECT
public:
    using ReadingTool::ReadingTool;

    void addTo(ReadingLayout& layout) override;
    void scanOpened(const Arrival&) override { line_mm_.clear(); }
    bool act(const ClickMeaning& meaning, const ClickedPoint& point) override;
    void escape() override;

private:
    void start();
    void measure(const MeasureBetween& ends);
    void show(const WallDistance& size, const std::optional<PlaneSize>& plane);
    void drawLine();

    std::vector<Point3> line_mm_;  // what was measured last
};

}  // namespace vicon::viewer
