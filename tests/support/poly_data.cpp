#include "vicon/support/poly_data.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>

namespace vicon::support {

vtkNew<vtkPolyData> asPolyData(const CellSurface& cells)
{
    vtkNew<vtkPoints> points;
    for (std::size_t n = 0; n < cells.pointCount(); ++n) {
        const Point3 p = cells.point(n);
        points->InsertNextPoint(p.x, p.y, p.z);
    }
    vtkNew<vtkCellArray> triangles;
    for (std::size_t t = 0; t < cells.triangleCount(); ++t) {
        const vtkIdType corners[3] = {vtkIdType(cells.triangles[3 * t]), vtkIdType(cells.triangles[3 * t + 1]),
                                      vtkIdType(cells.triangles[3 * t + 2])};
        triangles->InsertNextCell(3, corners);
    }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetPolys(triangles);
    return data;
}

}  // namespace vicon::support
