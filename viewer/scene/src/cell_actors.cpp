#include "cell_actors.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>

#include <algorithm>

namespace vicon::viewer {
namespace {

constexpr double kNear_mm = 0.3;    // well below the camera's radius, so that no wall is cut open
constexpr double kFar_mm = 2000;    // longer than any line of sight in a body
constexpr double kAside_mm = 1000;  // parallel projection: the eye's distance from the middle

vtkSmartPointer<vtkFloatArray> gathered(const std::vector<float>& values, const std::vector<std::uint32_t>& points)
{
    auto array = vtkSmartPointer<vtkFloatArray>::New();
    array->SetNumberOfComponents(3);
    array->SetNumberOfTuples(vtkIdType(points.size()));
    float* out = array->GetPointer(0);
    for (const std::uint32_t p : points)
        out = std::copy_n(values.data() + std::size_t(p) * 3, 3, out);
    return array;
}

vtkSmartPointer<vtkPolyData> cellData(const artefact::CellSurface& surface, const CellActor& cell,
                                      std::vector<std::uint32_t>& number_of)
{
    std::vector<std::uint32_t> points;
    vtkNew<vtkTypeInt32Array> corners, offsets;
    corners->SetNumberOfValues(vtkIdType(cell.triangles * 3));
    offsets->SetNumberOfValues(vtkIdType(cell.triangles + 1));
    for (std::size_t n = 0; n < 3 * cell.triangles; ++n) {
        const std::uint32_t p = surface.triangles[3 * cell.first_triangle + n];
        if (number_of[p] >= points.size() || points[number_of[p]] != p) {
            number_of[p] = std::uint32_t(points.size());
            points.push_back(p);
        }
        corners->SetValue(vtkIdType(n), int(number_of[p]));
    }
    for (std::size_t n = 0; n <= cell.triangles; ++n)
        offsets->SetValue(vtkIdType(n), int(3 * n));
    auto data = vtkSmartPointer<vtkPolyData>::New();
    vtkNew<vtkPoints> place;
    place->SetData(gathered(surface.points_mm, points));
    vtkNew<vtkCellArray> polys;
    polys->SetData(offsets, corners);
    data->SetPoints(place);
    data->SetPolys(polys);
    if (surface.normals.size() == surface.points_mm.size())
        data->GetPointData()->SetNormals(gathered(surface.normals, points));
    return data;
}

vtkSmartPointer<vtkActor> actorFor(vtkPolyData* data)
{
    vtkNew<vtkOpenGLPolyDataMapper> mapper;
    mapper->SetInputData(data);
    mapper->SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
    mapper->ScalarVisibilityOff();
    mapper->SetStatic(1);
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    return actor;
}

}  // namespace

std::vector<CellActor> cellActors(const artefact::CellSurface& surface)
{
    std::vector<CellActor> cells;
    std::vector<std::uint32_t> number_of(surface.pointCount(), 0);
    for (std::size_t first = 0; first < surface.triangleCount();) {
        CellActor cell;
        cell.segment = surface.segment[first];
        cell.first_triangle = first;
        while (first < surface.triangleCount() && surface.segment[first] == cell.segment)
            ++first;
        cell.triangles = first - cell.first_triangle;
        cell.data = cellData(surface, cell, number_of);
        cell.actor = actorFor(cell.data);
        cells.push_back(std::move(cell));
    }
    return cells;
}

void showOnly(std::vector<CellActor>& cells, const std::vector<int>& segments)
{
    for (CellActor& cell : cells)
        cell.actor->SetVisibility(segments.empty() ||
                                  std::find(segments.begin(), segments.end(), cell.segment) != segments.end());
}

void placeCamera(vtkCamera* camera, const Pose& pose, double view_angle_deg)
{
    const Point3 focus = pose.eye_mm + pose.forward;
    camera->ParallelProjectionOff();
    camera->SetPosition(pose.eye_mm.x, pose.eye_mm.y, pose.eye_mm.z);
    camera->SetFocalPoint(focus.x, focus.y, focus.z);
    camera->SetViewUp(pose.up.x, pose.up.y, pose.up.z);
    camera->SetViewAngle(view_angle_deg);
    camera->SetClippingRange(kNear_mm, kFar_mm);
}

void placeCamera(vtkCamera* camera, const PlaneView& view)
{
    const Point3 eye = view.centre_mm - view.forward() * kAside_mm;
    camera->ParallelProjectionOn();
    camera->SetPosition(eye.x, eye.y, eye.z);
    camera->SetFocalPoint(view.centre_mm.x, view.centre_mm.y, view.centre_mm.z);
    camera->SetViewUp(-view.down.x, -view.down.y, -view.down.z);
    camera->SetParallelScale(view.height / 2.0 * view.mm_per_pixel);
    camera->SetClippingRange(1, 2 * kAside_mm);
}

}  // namespace vicon::viewer
