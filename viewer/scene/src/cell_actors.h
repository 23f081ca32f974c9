#pragma once

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <vector>

#include "vicon/artefact/cells_file.h"
#include "vicon/viewer/model/camera.h"

namespace vicon::viewer {

/// One cell of the surface as VTK draws it.
struct CellActor {
    int segment = 0;
    std::size_t first_triangle = 0, triangles = 0;
    vtkSmartPointer<vtkPolyData> data;
    vtkSmartPointer<vtkActor> actor;
};

/// The cells in order; each holds only its own points. Corners keep the surface's coordinates to the bit, so that
/// neighbours meet without cracks.
std::vector<CellActor> cellActors(const artefact::CellSurface& surface);

void showOnly(std::vector<CellActor>& cells, const std::vector<int>& segments);

void placeCamera(vtkCamera* camera, const Pose& pose, double view_angle_deg);
void placeCamera(vtkCamera* camera, const PlaneView& view);

}  // namespace vicon::viewer
