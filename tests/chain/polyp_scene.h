#pragma once

#include <random>
#include <string>
#include <vector>

#include "vicon/core/cell_surface.h"
#include "vicon/core/geometry.h"

namespace vicon {

enum class PolypShape { sessile, flat, stalked };
enum class WallShape { plane, tube, fold };

/// A polyp in gas whose size is known, as a scanner shows it.
struct PolypScene {
    PolypShape shape = PolypShape::sessile;
    WallShape wall = WallShape::plane;
    double diameter_mm = 8;
    double blur_mm = 0.7;  ///< standard deviation
    double noise_hu = 0;
    unsigned seed = 1;  ///< of its direction, place and noise, and of the click on it
};

struct PolypOnWall {
    CellSurface surface;             ///< of the wall, by the tissue step
    Point3 click_mm;                 ///< near the polyp's top, on the wall
    std::vector<Point3> in_head_mm;  ///< places in the polyp's head, anywhere
};

/// Draws, blurs and segments the scene. Voxels of 0.7 mm.
PolypOnWall wallOf(const PolypScene& scene);

}  // namespace vicon
