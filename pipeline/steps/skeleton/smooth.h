#pragma once

#include <utility>
#include <vector>

#include "vicon/core/geometry.h"
#include "vicon/core/volume.h"
#include "vicon/steps/skeleton.h"

namespace vicon::steps {

/// The wall distance anywhere, interpolated; 0 outside the grid.
class DistanceProbe {
public:
    explicit DistanceProbe(const FieldVolume& wall_mm) : field_(wall_mm) {}
    /// With a box of the same lattice that takes the place of the whole there; at the box's own faces the two agree.
    DistanceProbe(const FieldVolume& wall_mm, const FieldVolume& box_mm);
    double at(Point3 p) const;
    bool inside(Point3 p) const;
    /// Whether the wall is farther away there because the box counts the rectal tube as lumen.
    bool overTube(Point3 p) const;
    double smallestSpacing_mm() const;

private:
    /// The volume that holds the voxel and those after it along all axes, and the voxel's index in it.
    std::pair<const FieldVolume&, Index3> holding(Index3 v) const;

    const FieldVolume& field_;
    const FieldVolume* box_ = nullptr;
    Index3 box_at_;
};

using Polyline = std::vector<Point3>;

/// Two unit vectors across the curve at each point, turning with it as little as possible.
struct Frame {
    Vector3 u, v;
};

/// Frames for all points; a tangent is taken over `reach` points on both sides.
std::vector<Frame> framesAlong(const Polyline& line, std::size_t reach);

/// What joins two points of a line: a straight line, or a cubic that goes on in the direction of their neighbours.
enum class Between { lines, curves };

/// Points at equal distances of about `step_mm`, ends kept.
Polyline resampled(const Polyline& line, double step_mm, Between between = Between::lines);

/// The line without what is shorter than about sigma: a Gaussian that keeps bends where they are. The line must be
/// sampled every `step_mm`; its ends stay.
Polyline smoothed(const Polyline& line, double sigma_mm, double step_mm);

/// Curvature of the line towards its centre, 1/mm, over 10 mm on either side; none near an end.
Vector3 bendAt(const Polyline& line, std::size_t n, double step_mm);

/// The point itself, or as near to it as the lumen allows on the way from a point inside.
Point3 keptInside(Point3 wanted, Point3 inside, const DistanceProbe& wall);

/// The smooth curve in the middle of the lumen that follows the path.
Polyline centredCurve(const Polyline& path, const DistanceProbe& wall, const SkeletonOptions& options);

}  // namespace vicon::steps
