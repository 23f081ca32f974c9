#include "subdivide/contour.h"

#include <vtkCellArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkShortArray.h>

#include <algorithm>

namespace vicon::steps {

Contour contourOf(Volume<std::int16_t>& field)
{
    vtkNew<vtkShortArray> values;
    values->SetArray(field.voxels.data(), vtkIdType(field.voxels.size()), 1);
    vtkNew<vtkImageData> image;
    image->SetDimensions(field.grid.size.data());
    image->SetOrigin(-1, -1, -1);
    image->GetPointData()->SetScalars(values);
    vtkNew<vtkFlyingEdges3D> edges;
    edges->SetInputData(image);
    edges->SetValue(0, 0);
    edges->ComputeNormalsOff();
    edges->ComputeScalarsOff();
    edges->Update();
    vtkPolyData* found = edges->GetOutput();
    Contour out;
    out.points.resize(std::size_t(found->GetNumberOfPoints()) * 3);
    for (vtkIdType n = 0; n < found->GetNumberOfPoints(); ++n) {
        double p[3];
        found->GetPoint(n, p);
        std::copy(p, p + 3, &out.points[std::size_t(3 * n)]);
    }
    out.on_edges = out.pointCount();
    out.triangles.reserve(std::size_t(found->GetNumberOfPolys()) * 3);
    vtkIdType count = 0;
    const vtkIdType* corners = nullptr;
    auto* polys = found->GetPolys();
    for (polys->InitTraversal(); polys->GetNextCell(count, corners);)
        for (vtkIdType n = 0; n < 3; ++n)
            out.triangles.push_back(std::uint32_t(corners[n]));
    return out;
}

}  // namespace vicon::steps
