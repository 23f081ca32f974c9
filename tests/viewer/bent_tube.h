#pragma once

#include <vector>

#include "vicon/core/cell_surface.h"
#include "vicon/core/skeleton.h"
#include "vicon/core/volume.h"

namespace vicon::viewer::test {

/// A polyp on the inside of a bend, on its outside, or on one of its sides.
struct TubePolyp {
    double along_bend = 0.5;  ///< of the bend's half circle
    double around_rad = 0;    ///< 0 on the bend's inside
};

/// A tube of closed form that goes straight, around by half a turn and back, with balls of tissue on its wall.
struct BentTube {
    Skeleton skeleton;
    CellSurface surface;
    FieldVolume exit_distance;
    std::vector<Point3> polyps_mm;  ///< the middles of the balls, on the wall

    BentTube(double bend_radius_mm, double tube_radius_mm, const std::vector<TubePolyp>& polyps, double polyp_radius_mm,
             bool folds = false);
};

}  // namespace vicon::viewer::test
