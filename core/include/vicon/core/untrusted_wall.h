#pragma once

#include <vector>

#include "vicon/core/geometry.h"
#include "vicon/core/mottled_tagging.h"

namespace vicon {

/// A place of a wall between two parts of the lumen, apart by way of it, that the scan shows so faintly that a hole
/// would have been drawn. It is drawn closed.
struct FaintWall {
    Point3 middle_mm;
    double area_mm2 = 0;  ///< that was closed
};

/// Where a reader must not trust the wall that is drawn.
struct UntrustedWall {
    MottledTagging mottled;
    std::vector<FaintWall> faint;
};

}  // namespace vicon
