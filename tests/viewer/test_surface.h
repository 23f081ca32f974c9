#pragma once

#include <functional>
#include <vector>

#include "vicon/core/geometry.h"
#include "vicon/scan_files/cells_file.h"

namespace vicon::viewer::test {

/// The zero surface of a field with these values at the voxels of a grid, normals from the field's gradient towards
/// where it falls, triangles sorted by segment, front side towards where the field is below 0.
CellSurface surfaceOf(const Grid& grid, const std::vector<float>& values, const std::function<double(Point3)>& field,
                      const std::function<int(Point3)>& segment);

}  // namespace vicon::viewer::test
