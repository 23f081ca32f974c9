#pragma once

#include <vector>

#include "vicon/core/cell_surface.h"
#include "vicon/core/progress.h"
#include "vicon/core/volume_view.h"
#include "vicon/viewer/model/path_frames.h"

namespace vicon::viewer {

/// The station of each point of a surface: of the nearest place of the path among those about as far from the exit, so
/// of its own loop. Beyond the path's ends stations go on, below 0 and above its length.
std::vector<float> stationsOfWall(const CellSurface& surface, const PathFrames& path, const FieldView& exit_distance,
                                  Progress& progress);

}  // namespace vicon::viewer
