#pragma once

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <vector>

#include "patch_mapper.h"
#include "vicon/scan_files/cells_file.h"
#include "vicon/viewer/model/camera.h"
#include "vicon/viewer/model/patches.h"
#include "vicon/viewer/scene/cell_visibility.h"

namespace vicon::viewer {

/// Pictures from within are cut off nearer than this: well below the camera's radius, so that no wall is cut open.
constexpr double kNearPlane_mm = 0.3;

/// One cell of the surface as VTK draws it.
struct CellActor {
    int segment = 0;
    std::size_t first_triangle = 0, triangles = 0;
    vtkSmartPointer<vtkPolyData> data;
    vtkSmartPointer<vtkActor> actor;
    vtkSmartPointer<PatchMapper> mapper;
    std::size_t drawn = 0;  ///< triangles shown
};

/// The cells in order; each holds only its own points. Corners keep the surface's coordinates to the bit, so that
/// neighbours meet without cracks.
std::vector<CellActor> cellActors(const CellSurface& surface);

/// Whole cells; empty: all.
void showOnly(std::vector<CellActor>& cells, const std::vector<int>& segments);
/// Only the patches that `parts` names, among those of its cells.
/// @param patches of the whole surface, as many as parts.patches tells of
void showPatches(std::vector<CellActor>& cells, const std::vector<Patch>& patches, const VisibleParts& parts);

/// The next picture hands the driver also what is not shown, without drawing it; else a cell is handed over when it is
/// shown for the first time.
void sendAll(std::vector<CellActor>& cells);

/// Gives each corner of a triangle the value of its point, as an attribute of the shader.
/// @param values one for each point of the surface
void addAttribute(std::vector<CellActor>& cells, const CellSurface& surface, const char* name,
                  const std::vector<float>& values);

void placeCamera(vtkCamera* camera, const Pose& pose, double view_angle_deg);

}  // namespace vicon::viewer
