#include "cell_actors.h"

#include <vtkCellArray.h>
#include <vtkDataObject.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>

#include <algorithm>

namespace vicon::viewer {
namespace {

constexpr double kFar_mm = 2000;  // longer than any line of sight in a body

vtkSmartPointer<vtkFloatArray> gathered(const std::vector<float>& values, const std::vector<std::uint32_t>& points,
                                        std::size_t components = 3)
{
    auto array = vtkSmartPointer<vtkFloatArray>::New();
    array->SetNumberOfComponents(int(components));
    array->SetNumberOfTuples(vtkIdType(points.size()));
    float* out = array->GetPointer(0);
    for (const std::uint32_t p : points)
        out = std::copy_n(values.data() + std::size_t(p) * components, components, out);
    return array;
}

/// The surface's points that a cell holds, in the order in which its triangles first name them.
std::vector<std::uint32_t> pointsOf(const CellSurface& surface, const CellActor& cell,
                                    std::vector<std::uint32_t>& number_of)
{
    std::vector<std::uint32_t> points;
    for (std::size_t n = 0; n < 3 * cell.triangles; ++n) {
        const std::uint32_t p = surface.triangles[3 * cell.first_triangle + n];
        if (number_of[p] >= points.size() || points[number_of[p]] != p) {
            number_of[p] = std::uint32_t(points.size());
            points.push_back(p);
        }
    }
    return points;
}

vtkSmartPointer<vtkPolyData> cellData(const CellSurface& surface, const CellActor& cell,
                                      std::vector<std::uint32_t>& number_of)
{
    const std::vector<std::uint32_t> points = pointsOf(surface, cell, number_of);
    vtkNew<vtkTypeInt32Array> corners, offsets;
    const auto triangles = vtkIdType(cell.triangles);
    corners->SetNumberOfValues(triangles * 3);
    offsets->SetNumberOfValues(triangles + 1);
    for (std::size_t n = 0; n < 3 * cell.triangles; ++n)
        corners->SetValue(vtkIdType(n), int(number_of[surface.triangles[3 * cell.first_triangle + n]]));
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

void makeActor(CellActor& cell)
{
    cell.mapper = vtkSmartPointer<PatchMapper>::New();
    cell.mapper->SetInputData(cell.data);
    cell.mapper->SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
    cell.mapper->ScalarVisibilityOff();
    cell.mapper->SetStatic(1);
    cell.actor = vtkSmartPointer<vtkActor>::New();
    cell.actor->SetMapper(cell.mapper);
    cell.drawn = cell.triangles;
}

/// What is drawn of a cell. Other cells' patches are not looked at: they are many.
std::vector<TriangleRun> runsOf(const CellActor& cell, const std::vector<Patch>& patches, const VisibleParts& parts)
{
    std::vector<TriangleRun> runs;
    if (std::find(parts.segments.begin(), parts.segments.end(), cell.segment) == parts.segments.end())
        return runs;
    const auto of_cell = std::partition_point(patches.begin(), patches.end(),
                                              [&](const Patch& p) { return p.first_triangle < cell.first_triangle; });
    for (auto p = of_cell; p != patches.end() && p->cell == cell.segment; ++p) {
        if (!parts.patches[std::size_t(p - patches.begin())])
            continue;
        const std::size_t first = p->first_triangle - cell.first_triangle;
        if (!runs.empty() && runs.back().first + runs.back().count == first)
            runs.back().count += p->triangles;
        else
            runs.push_back({first, p->triangles});
    }
    return runs;
}

}  // namespace

std::vector<CellActor> cellActors(const CellSurface& surface)
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
        makeActor(cell);
        cells.push_back(std::move(cell));
    }
    return cells;
}

void showOnly(std::vector<CellActor>& cells, const std::vector<int>& segments)
{
    for (CellActor& cell : cells) {
        const bool shown =
            segments.empty() || std::find(segments.begin(), segments.end(), cell.segment) != segments.end();
        cell.mapper->drawAll();
        cell.actor->SetVisibility(shown);
        cell.drawn = shown ? cell.triangles : 0;
    }
}

void showPatches(std::vector<CellActor>& cells, const std::vector<Patch>& patches, const VisibleParts& parts)
{
    for (CellActor& cell : cells) {
        const std::vector<TriangleRun> runs = runsOf(cell, patches, parts);
        cell.drawn = 0;
        for (const TriangleRun& run : runs)
            cell.drawn += run.count;
        cell.actor->SetVisibility(!runs.empty());
        cell.mapper->drawOnly(runs);
    }
}

void sendAll(std::vector<CellActor>& cells)
{
    for (CellActor& cell : cells)
        if (!cell.actor->GetVisibility()) {
            cell.mapper->drawOnly({});
            cell.actor->SetVisibility(true);
        }
}

void addAttribute(std::vector<CellActor>& cells, const CellSurface& surface, const char* name,
                  const std::vector<float>& values)
{
    std::vector<std::uint32_t> number_of(surface.pointCount(), 0);
    for (CellActor& cell : cells) {
        const auto of_cell = gathered(values, pointsOf(surface, cell, number_of), 1);
        of_cell->SetName(name);
        cell.data->GetPointData()->AddArray(of_cell);
        cell.mapper->MapDataArrayToVertexAttribute(name, name, vtkDataObject::FIELD_ASSOCIATION_POINTS);
    }
}

void placeCamera(vtkCamera* camera, const Pose& pose, double view_angle_deg)
{
    const Point3 focus = pose.eye_mm + pose.forward;
    camera->ParallelProjectionOff();
    camera->SetPosition(pose.eye_mm.x, pose.eye_mm.y, pose.eye_mm.z);
    camera->SetFocalPoint(focus.x, focus.y, focus.z);
    camera->SetViewUp(pose.up.x, pose.up.y, pose.up.z);
    camera->SetViewAngle(view_angle_deg);
    camera->SetClippingRange(kNearPlane_mm, kFar_mm);
}

}  // namespace vicon::viewer
