#pragma once

#include <map>
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
    void scanStays() override { sayWhatWasGivenUp(); }
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
        std::vector<Point3> way_mm;  // from one end to the other; none where it is measured for the first time
        std::string marker_id;
        int request = 0;                 // the last one for it, while that is under way; afterwards whence it is
        std::vector<Point3> dragged_mm;  // its two ends while one is dragged; else none
    };
    /// What is being measured or outlined. Its result is this marker's, whatever is shown by then.
    struct Request {
        std::string scan_id;
        std::string marker_id;        // whose size was dragged; else empty: the one beside it gets it
        std::vector<Point3> ends_mm;  // none of an outline
    };
    Shown shownOf(const Marker& marker) const;
    void connectViews();
    /// What lies in a scan that is neither read nor beside any more is given up.
    void forgetClosed();
    void start();
    void showLine();
    std::optional<MeasuredLine> line() const;
    /// Of the line that is shown: where they are dragged to, or measured anew.
    std::vector<Point3> endsNow() const;
    /// @param to nothing where no wall is: an end that is let go there stays where it was
    void drag(int end, const std::optional<ClickedPoint>& to, GripDrag how);
    /// Of the line that is shown, whose size stays until the new one is there.
    /// @param last in whose scan, and seen from where
    void measure(Point3 from, Point3 to, bool on_wall, const ClickedPoint& last);
    void startOutline();
    void outlined(int request, const PolypOutline& outline);
    void measured(int request, const WallDistance& size, const std::optional<PlaneSize>& plane);
    void notMeasured(int request);
    void sayWhatWasGivenUp();
    /// Nothing where it was given up.
    std::optional<Request> finished(int request);
    void giveUp(int request);
    /// What is measured for no marker yet, and never will be: the reader begins anew.
    bool giveUpNew();
    /// Shows it, unless something else is shown by now; then it is kept with its marker.
    void take(const Shown& result);
    void offer(const Shown& result);
    void ask(const Marker& marker, const Shown& result);
    void keep(const std::string& marker_id, const Shown& result);

    std::optional<Shown> shown_;
    std::map<int, Request> requests_;  // under way, by number
    int last_request_ = 0;
    std::vector<Shown> waiting_;  // measured while a marker was being saved, which may be the one beside it
    bool given_up_ = false;       // as another scan was opened
};

}  // namespace vicon::viewer
