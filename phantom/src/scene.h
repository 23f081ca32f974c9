#pragma once

#include <vector>

#include "anatomy.h"
#include "course.h"

namespace vicon::phantom {

/// A solid of even density, or of two densities with a level between them.
struct Solid {
    enum class Kind { ellipsoid, capsule };
    Kind kind = Kind::ellipsoid;
    Point3 a, b;       ///< centre; a capsule's two ends
    Vector3 radii_mm;  ///< a capsule's radius is x
    double density_hu = 0;
    bool has_level = false;
    double level_mm = 0;  ///< height of gas over the rest
};

/// Distance to a solid's surface to first order, below 0 inside.
double distanceTo(const Solid& solid, Point3 p);

/// All that surrounds the colon.
struct Scene {
    Trunk trunk;
    Vector3 down;               ///< gravity
    double table_mm = 0;        ///< depth of the table's top in the middle
    std::vector<Solid> organs;  ///< painted in this order, before the lungs
    std::vector<Solid> bones;   ///< painted after the lungs, with vessels and gut
    std::vector<Solid> tube;    ///< rectal catheter; empty without. Its hollow follows its wall
};

Scene drawScene(std::uint64_t seed, const DrawnCourse& drawn, Position position, bool catheter);

}  // namespace vicon::phantom
