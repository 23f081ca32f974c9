#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "vicon/core/geometry.h"

namespace vicon::artefact {

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

/// Writes each as NAME.png into `folder` (made when absent), and projections.json:
/// {"projections":[{"name","file","width","height","pixel_mm","right":[x,y,z],"down":[x,y,z],"first_pixel_mm":[x,y,z]}]}
/// so that column = (p - first_pixel_mm) . right / pixel_mm. The PNG files carry the same as the text "vicon:mapping".
/// Throws Error{store}.
void writeProjections(const std::filesystem::path& folder, std::span<const Projection> projections);

/// Reads one of them back. Throws Error{not_found}, or Error{bad_input} when the description or the picture is damaged
/// or one does not fit the other.
Projection readProjection(const std::filesystem::path& folder, const std::string& name);

}  // namespace vicon::artefact
