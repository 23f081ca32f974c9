#pragma once

#include <vector>

#include "reading/reading_tool.h"
#include "slices/measured_line.h"
#include "vicon/cases/polyp_size.h"
#include "vicon/viewer/model/plane_size.h"
#include "vicon/viewer/model/wall_distance.h"

namespace vicon::viewer {

/// The size of a finding between two clicks, along the wall or straight, or of a polyp that one click outlines:
/// callipers in every view of the scan, read or beside, whose ends can be dragged; kept with the marker beside it. A
/// size that a marker has is replaced only when the reader says so.
class MeasuringTool : public ReadingTool {
    Q_OBJECT
public:
    using ReadingTool::ReadingTool;

    void addTo(ReadingLayout& layout) override;
    void scanOpened(const Arrival& arrival) override;
    void markersChanged() override;
    void markerShown(const Marker& marker) override;
    bool act(const ClickMeaning& meaning, const ClickedPoint& point) override;
    void nextClickChanged() override { showLine(); }
    void escape() override;

private:
    /// A size in one scan, and the marker that it is kept with; none yet where that is empty.
    struct Shown {
        std::string scan_id;
        MarkerSize size;
        std::vector<Point3> way_mm;  // from one end to the other
        std::string marker_id;
        std::vector<Point3> dragged_mm;  // its two ends while one is dragged; else none
    };
    static Shown shownOf(const Marker& marker);
    void connectViews();
    /// What lies in a scan that is neither read nor beside any more is given up.
    void forgetClosed();
    void start();
    void showLine();
    std::optional<MeasuredLine> line() const;
    /// @param to nothing where no wall is: an end that is let go there stays where it was
    void drag(int end, const std::optional<ClickedPoint>& to, bool released);
    /// @param last in whose scan, and seen from where
    void measure(Point3 from, Point3 to, bool on_wall, const ClickedPoint& last);
    void startOutline();
    void outlined(const std::string& scan_id, const PolypOutline& outline);
    void measured(const std::string& scan_id, const WallDistance& size, const std::optional<PlaneSize>& plane);
    void finish();
    void ask(const Marker& marker, const MarkerSize& size);
    void keep(const std::string& marker_id, const MarkerSize& size);

    std::optional<Shown> shown_;
};

}  // namespace vicon::viewer
