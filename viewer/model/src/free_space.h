#pragma once

#include <vector>

#include "vicon/viewer/model/lumen.h"

namespace vicon::viewer {

/// Where the middle of a ball may be so that no wall lies within the ball.
class FreeSpace {
public:
    static constexpr double kMostStep_mm = 0.5;  ///< of moved(): steps over no wall

    FreeSpace(const Lumen& lumen, double radius_mm) : lumen_(lumen), least_mm_(radius_mm + lumen.halfDiagonal_mm()) {}

    /// What the distance field must say: that of a voxel may promise half a diagonal more than there is.
    double least_mm() const { return least_mm_; }
    bool holds(Point3 p) const { return lumen_.inside(p) && lumen_.clearance_mm(p) >= least_mm_; }
    /// Whether the ball can go from one place to the other in a straight line.
    bool straightWay(Point3 from, Point3 to) const;
    /// Where the ball at `from`, which it holds, is after some time. Where a step would leave, it slides along the
    /// wall, and the velocity loses what leads into it; where that would leave, it stays.
    Point3 moved(Point3 from, Vector3& velocity_mm_s, double seconds) const;
    /// A way for the ball to the one of `goals` that is reached by the fewest steps of a voxel: the places to make for,
    /// the goal first, and its number. Found within a cube of `reach_mm` around `from`.
    struct Way {
        std::vector<Point3> places;
        std::size_t goal = 0;
        bool found() const { return !places.empty(); }
    };
    Way wayTo(const std::vector<Point3>& goals, Point3 from, double reach_mm) const;

private:
    Lumen lumen_;
    double least_mm_;
};

}  // namespace vicon::viewer
