#pragma once

#include "vicon/core/volume_view.h"

namespace vicon::viewer {

/// The inside of the colon as flight sees it: labels and distance to the wall. The voxels of both must outlive it.
class Lumen {
public:
    Lumen(const InsideView& inside, const FieldView& wall_distance);

    /// Whether the voxel at `p` is gas or tagged fluid.
    bool inside(Point3 p) const;
    /// Distance to the wall, trilinear; 0 outside.
    double clearance_mm(Point3 p) const;
    /// Direction in which the wall recedes fastest, per millimetre; zero where it does not.
    Vector3 clearanceGradient(Point3 p) const;
    /// Half a voxel's diagonal: how much nearer the wall may be than the field of a voxel says.
    double halfDiagonal_mm() const { return half_diagonal_mm_; }
    /// The smallest of the voxel's sides.
    double voxel_mm() const { return 2 * step_mm_; }
    /// Radius of a ball around `p` that holds no wall, from the nearest voxel alone: quick, and never too large. May be
    /// negative.
    double freeBall_mm(Point3 p) const { return wallAt(wall_.grid.indexAt(p)) - 2 * half_diagonal_mm_; }
    /// Whether the straight line between two points stays in the lumen, but for its last `allowance_mm` before `to`.
    bool sees(Point3 from, Point3 to, double allowance_mm = 0) const;
    /// The point of an inside voxel nearest to `p`, at most `within_mm` away; `p` itself when it is inside. False
    /// where there is none.
    struct Nearest {
        bool found = false;
        Point3 position_mm;
        double distance_mm = 0;
    };
    Nearest nearestInside(Point3 p, double within_mm) const;

private:
    double wallAt(Index3 v) const { return wall_.valueOr(v, 0.F); }

    InsideView inside_;
    FieldView wall_;
    double half_diagonal_mm_ = 0;
    double step_mm_ = 0;
};

}  // namespace vicon::viewer
