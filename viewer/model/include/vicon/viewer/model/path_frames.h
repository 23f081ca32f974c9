#pragma once

#include <vector>

#include "vicon/core/skeleton.h"
#include "vicon/viewer/model/camera.h"

namespace vicon::viewer {

/// A place on the path with a frame that turns no more about the path than the path's bends ask for.
struct PathFrame {
    Point3 position_mm;
    Vector3 forward;  ///< unit vector towards the caecum
    Vector3 up;       ///< orthogonal to it
    double radius_mm = 0;
    bool on_bridge = false;
};

/// Rotation-minimising frames along a skeleton, by double reflection (Wang, Jüttler, Zheng, Liu: Computation of
/// Rotation Minimizing Frames, ACM Transactions on Graphics 27(1), 2008). At the rectum up is anterior as far as the
/// path allows.
class PathFrames {
public:
    /// @param step_mm distance of the frames that are kept
    /// @param window_mm length of curve that a direction is taken over: long enough that the picture does not shake
    explicit PathFrames(const Skeleton& skeleton, double step_mm = 1, double window_mm = 12);
    /// Of a cavity, which no path leads through: this place alone, at every station.
    static PathFrames withoutPath(const PathFrame& home);

    bool isPath() const { return length_mm_ > 0; }

    double length_mm() const { return length_mm_; }  ///< 0: no path
    /// The frame at a station, interpolated; stations outside are clamped to the ends.
    PathFrame at(double station_mm) const;
    /// The station nearest to a point among those at most `reach_mm` from `around_mm`.
    double nearestStation(Point3 p, double around_mm, double reach_mm) const;

    /// A way that tapers off, as those of an airway: the eye follows it to its tip, however narrow. A colon is narrow
    /// where it is collapsed, and there the eye looks from the next wide place.
    void setTapers(bool tapers) { tapers_ = tapers; }
    bool tapers() const { return tapers_; }

private:
    PathFrames() = default;

    std::vector<PathFrame> frames_;
    double step_mm_ = 1;
    double length_mm_ = 0;
    bool tapers_ = false;
};

}  // namespace vicon::viewer
