#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "vicon/artefact/cells_file.h"
#include "vicon/core/options.h"
#include "vicon/core/progress.h"

namespace vicon::steps {

struct ProjectionOptions {
    double pixel_mm = 0.6;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("projections.pixel_mm", pixel_mm, "mm", "Edge of a pixel of the projections.", OptionLimits{0.2, 5});
    }
};

/// A shaded parallel projection of the surface, and where its pixels lie.
struct ProjectionPicture {
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

/// The three projections: coronal seen from the front, transverse seen from the feet (both with the patient's right on
/// the picture's left), sagittal seen from the patient's left (front on the picture's left). Head up, front up in the
/// transverse one. Computed without OpenGL. Throws Error{bad_input} when the surface is empty.
std::array<ProjectionPicture, 3> project(const artefact::CellSurface& surface, const ProjectionOptions& options,
                                         Progress& progress);

/// Writes coronal.png, transverse.png and sagittal.png into `folder` (made when absent), and projections.json:
/// {"projections":[{"name","file","width","height","pixel_mm","right":[x,y,z],"down":[x,y,z],"first_pixel_mm":[x,y,z]}]}
/// so that column = (p - first_pixel_mm) . right / pixel_mm. The PNG files carry the same as the text "vicon:mapping".
void writeProjections(const std::filesystem::path& folder, const artefact::CellSurface& surface,
                      const ProjectionOptions& options, Progress& progress);

/// Reads the mapping back (without pixels). Throws Error{not_found} or Error{bad_input}.
std::array<ProjectionPicture, 3> readProjectionMapping(const std::filesystem::path& folder);

}  // namespace vicon::steps
