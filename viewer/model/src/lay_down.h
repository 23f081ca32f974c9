#pragma once

#include <vector>

#include "even_out.h"
#include "vicon/core/cell_surface.h"
#include "vicon/core/progress.h"

namespace vicon::viewer {

/// Lays down what is folded over in a band, as behind an overhang: the points of triangles that are seen from behind,
/// and those beside, each become the mean of their neighbours. A map of means has no fold where its
/// border has none (W. Tutte, How to Draw a Graph, 1963; M. Floater, Mathematics of Computation 72, 2003).
/// @param station_mm and `around_rad`, from -pi to pi, of each point; they become those of the band laid down
/// Throws Error{cancelled}.
void layDown(std::vector<float>& station_mm, std::vector<float>& around_rad, const CellSurface& surface,
             const SurfaceNeighbors& neighbors, Progress& progress);

}  // namespace vicon::viewer
