#pragma once

#include <vtkNew.h>
#include <vtkPolyData.h>

#include "vicon/scan_files/cells_file.h"

namespace vicon::support {

/// The triangles of all cells, in LPS mm, for VTK's locators.
vtkNew<vtkPolyData> asPolyData(const CellSurface& cells);

}  // namespace vicon::support
