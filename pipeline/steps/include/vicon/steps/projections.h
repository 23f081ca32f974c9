#pragma once

#include <array>

#include "vicon/core/cell_surface.h"
#include "vicon/core/options.h"
#include "vicon/core/progress.h"
#include "vicon/core/projection.h"

namespace vicon::steps {

struct ProjectionOptions {
    double pixel_mm = 0.6;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("projections.pixel_mm", pixel_mm, "mm", "Edge of a pixel of the projections.", OptionLimits{0.2, 5});
    }
};

/// The three projections: coronal seen from the front, transverse seen from the feet (both with the patient's right on
/// the picture's left), sagittal seen from the patient's left (front on the picture's left). Head up, front up in the
/// transverse one. Computed without OpenGL. Throws Error{bad_input} when the surface is empty.
std::array<Projection, 3> project(const CellSurface& surface, const ProjectionOptions& options, Progress& progress);

}  // namespace vicon::steps
