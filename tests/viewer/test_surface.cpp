#include "test_surface.h"

#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <numeric>

namespace vicon::viewer::test {
namespace {

vtkNew<vtkFlyingEdges3D> contoured(const Grid& grid, const std::vector<float>& values)
{
    vtkNew<vtkImageData> image;  // in voxels: this VTK's images know no directions that the filter heeds
    image->SetDimensions(grid.size.data());
    image->AllocateScalars(VTK_FLOAT, 1);
    std::copy(values.begin(), values.end(), static_cast<float*>(image->GetScalarPointer()));
    vtkNew<vtkFlyingEdges3D> contour;
    contour->SetInputData(image);
    contour->SetValue(0, 0);
    contour->ComputeNormalsOff();
    contour->Update();
    return contour;
}

Vector3 downhill(const std::function<double(Point3)>& field, Point3 p)
{
    constexpr double h = 0.5;
    const auto slope = [&](Vector3 d) { return field(p - d) - field(p + d); };
    return normalized({slope({h, 0, 0}), slope({0, h, 0}), slope({0, 0, h})});
}

Point3 pointOf(const CellSurface& s, std::size_t corner)
{
    return s.point(s.triangles[corner]);
}

Vector3 normalOf(const CellSurface& s, std::size_t corner)
{
    const std::size_t n = 3 * std::size_t(s.triangles[corner]);
    return {s.normals[n], s.normals[n + 1], s.normals[n + 2]};
}

}  // namespace

CellSurface surfaceOf(const Grid& grid, const std::vector<float>& values, const std::function<double(Point3)>& field,
                      const std::function<int(Point3)>& segment)
{
    const auto contour = contoured(grid, values);
    vtkPolyData* data = contour->GetOutput();
    CellSurface raw;
    for (vtkIdType n = 0; n < data->GetNumberOfPoints(); ++n) {
        double c[3];
        data->GetPoint(n, c);
        const Point3 p = grid.pointAt(ContinuousIndex3{c[0], c[1], c[2]});
        const Vector3 normal = downhill(field, p);
        for (const double v : {p.x, p.y, p.z})
            raw.points_mm.push_back(float(v));
        for (const double v : {normal.x, normal.y, normal.z})
            raw.normals.push_back(float(v));
    }
    double facing = 0;  // the filter turns all triangles the same way; which way depends on the grid's handedness
    vtkNew<vtkIdList> ids;
    for (vtkIdType n = 0; n < data->GetNumberOfPolys(); ++n) {
        data->GetCellPoints(n, ids);
        for (vtkIdType c = 0; c < 3; ++c)
            raw.triangles.push_back(std::uint32_t(ids->GetId(c)));
        const std::size_t first = raw.triangles.size() - 3;
        const Point3 a = pointOf(raw, first), b = pointOf(raw, first + 1), c = pointOf(raw, first + 2);
        const Point3 middle = a + ((b - a) + (c - a)) / 3;
        facing += dot(cross(b - a, c - a), normalOf(raw, first));
        raw.segment.push_back(std::uint16_t(segment(middle)));
    }
    for (std::size_t n = 0; facing < 0 && n < raw.triangles.size(); n += 3)
        std::swap(raw.triangles[n + 1], raw.triangles[n + 2]);
    std::vector<std::size_t> order(raw.segment.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return raw.segment[a] < raw.segment[b]; });
    CellSurface sorted;
    sorted.points_mm = raw.points_mm;
    sorted.normals = raw.normals;
    for (const std::size_t n : order) {
        sorted.triangles.insert(sorted.triangles.end(), raw.triangles.begin() + std::ptrdiff_t(3 * n),
                                raw.triangles.begin() + std::ptrdiff_t(3 * n + 3));
        sorted.segment.push_back(raw.segment[n]);
    }
    return sorted;
}

}  // namespace vicon::viewer::test
