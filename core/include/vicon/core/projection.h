#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vicon/core/geometry.h"

namespace vicon {

/// A shaded parallel projection of the surface, and where its pixels lie.
struct Projection {
    std::string name;  ///< "coronal", "transverse" or "sagittal"
    int width = 0, height = 0;
    double pixel_mm = 0;
    Vector3 right;                   ///< LPS direction of growing column
    Vector3 down;                    ///< LPS direction of growing row
    Point3 first_pixel_mm;           ///< LPS point whose projection is the centre of column 0, row 0
    std::vector<std::uint8_t> rgba;  ///< row by row; transparent where there is no surface

    double column(Point3 p) const { return dot(p - first_pixel_mm, right) / pixel_mm; }
    double row(Point3 p) const { return dot(p - first_pixel_mm, down) / pixel_mm; }
};

}  // namespace vicon
