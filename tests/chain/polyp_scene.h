#pragma once

#include <limits>
#include <vector>

#include "vicon/core/cell_surface.h"
#include "vicon/core/geometry.h"
#include "vicon/core/volume.h"

namespace vicon {

enum class PolypShape { sessile, flat, stalked };
/// A bend of 40 mm: the polyp on its outer side, or on the inner one, where the wall is a saddle.
enum class WallShape { plane, tube, outside_bend, inside_bend, fold };

/// A polyp in gas whose size is known, as a scanner shows it.
struct PolypScene {
    PolypShape shape = PolypShape::sessile;
    WallShape wall = WallShape::plane;
    double diameter_mm = 8;
    double blur_mm = 0.7;  ///< standard deviation
    double noise_hu = 0;
    unsigned seed = 1;  ///< of its direction, place and noise, and of the click on it
    double longer = 1;  ///< than wide, in a direction along the wall
    double apart = 0;   ///< of a second polyp of this kind, in diameters from middle to middle; 0: there is none
    double fluid_from_mm = std::numeric_limits<double>::infinity();  ///< along gravity, from the scene's middle
};

/// Of the polyp's head, where it stands out of the wall.
struct PolypTruth {
    double diameter_mm = 0, volume_ml = 0;
};
PolypTruth truthOf(const PolypScene& scene);

struct PolypOnWall {
    CellSurface surface;             ///< of the wall, by the tissue step
    InsideVolume lumen;              ///< by the same
    Point3 click_mm;                 ///< near the polyp's top, on the wall
    std::vector<Point3> in_head_mm;  ///< places in the polyp's head, anywhere
    Vector3 along, up;               ///< unit vectors: in which the polyp is long, and into the lumen
};

/// Draws, blurs and segments the scene. Voxels of 0.7 mm.
PolypOnWall wallOf(const PolypScene& scene);

}  // namespace vicon
