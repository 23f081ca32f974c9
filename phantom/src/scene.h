#pragma once

#include <vector>

#include "anatomy.h"
#include "course.h"
#include "random.h"

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

/// A direction drawn evenly from all.
Vector3 anyDirection(Random& random);

/// Whether a ball lies in the room for gut, 2 mm from its wall.
bool inBelly(const Trunk& trunk, Point3 p, double radius_mm);

/// All that surrounds the colon.
struct Scene {
    Trunk trunk;
    Vector3 down;                    ///< gravity
    double table_mm = 0;             ///< depth of the table's top in the middle
    double wall_hu = 0;              ///< of the colon
    std::vector<Solid> organs;       ///< painted in this order, before the lungs
    std::vector<Solid> bones;        ///< painted after the lungs, with vessels and gut
    std::vector<Solid> ileum_wall;   ///< terminal ileum, painted before the colon; empty without
    std::vector<Solid> ileum_lumen;  ///< and what it holds, painted after the colon
    std::vector<Solid> tube;         ///< rectal catheter; empty without. Its hollow follows its wall
};

/// What of the patient is no matter of chance.
struct SceneOptions {
    bool catheter = true;
    bool contrast = false;   ///< medium in the veins
    bool metal_hip = false;  ///< the right one
};

Scene drawScene(std::uint64_t seed, const DrawnCourse& drawn, Position position, const SceneOptions& options);

}  // namespace vicon::phantom
