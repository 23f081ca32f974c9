#include "vicon/artefact/skeleton_file.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include "poly_data_file.h"
#include "vicon/core/error.h"

namespace fs = std::filesystem;

namespace vicon::artefact {
namespace {

vtkNew<vtkPoints> doublePoints()
{
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    return points;
}

void addLine(vtkCellArray* lines, vtkIdType first, vtkIdType count)
{
    lines->InsertNextCell(int(count));
    for (vtkIdType n = 0; n < count; ++n)
        lines->InsertCellPoint(first + n);
}

Point3 pointOf(vtkPolyData* data, vtkIdType id)
{
    double p[3];
    data->GetPoint(id, p);
    return {p[0], p[1], p[2]};
}

}  // namespace

void writeSkeleton(const fs::path& file, const Skeleton& skeleton)
{
    const auto points = doublePoints();
    vtkNew<vtkCellArray> lines;
    vtkNew<vtkDoubleArray> station, radius;
    vtkNew<vtkUnsignedCharArray> bridge;
    station->SetName("station_mm");
    radius->SetName("radius_mm");
    bridge->SetName("bridge");
    for (const SkeletonPiece& piece : skeleton.pieces) {
        addLine(lines, points->GetNumberOfPoints(), vtkIdType(piece.points.size()));
        bridge->InsertNextValue(piece.bridge ? 1 : 0);
        for (const SkeletonPoint& p : piece.points) {
            points->InsertNextPoint(p.position_mm.x, p.position_mm.y, p.position_mm.z);
            station->InsertNextValue(p.station_mm);
            radius->InsertNextValue(p.radius_mm);
        }
    }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetLines(lines);
    data->GetPointData()->AddArray(station);
    data->GetPointData()->AddArray(radius);
    data->GetCellData()->AddArray(bridge);
    writePolyData(file, data);
}

Skeleton readSkeleton(const fs::path& file)
{
    const auto data = readPolyData(file);
    auto* station = data->GetPointData()->GetArray("station_mm");
    auto* radius = data->GetPointData()->GetArray("radius_mm");
    auto* bridge = data->GetCellData()->GetArray("bridge");
    if (!station || !radius || !bridge || data->GetNumberOfLines() == 0)
        throw Error(ErrorCode::bad_input, "is not a skeleton", file.string(), "run 'vicon work' to make it anew");
    Skeleton skeleton;
    vtkNew<vtkIdList> ids;
    for (vtkIdType line = 0; line < data->GetNumberOfLines(); ++line) {
        data->GetLines()->GetCellAtId(line, ids);
        SkeletonPiece piece;
        piece.bridge = bridge->GetTuple1(line) != 0;
        for (vtkIdType n = 0; n < ids->GetNumberOfIds(); ++n) {
            const vtkIdType id = ids->GetId(n);
            piece.points.push_back({pointOf(data, id), station->GetTuple1(id), radius->GetTuple1(id)});
        }
        if (piece.points.size() < 2)
            throw Error(ErrorCode::bad_input, "has a piece of fewer than two points", file.string());
        skeleton.pieces.push_back(std::move(piece));
    }
    return skeleton;
}

void writeSkeletonVoxels(const fs::path& file, const SkeletonVoxels& paths)
{
    const auto points = doublePoints();
    vtkNew<vtkCellArray> lines;
    for (const auto& path : paths) {
        addLine(lines, points->GetNumberOfPoints(), vtkIdType(path.size()));
        for (const Point3& p : path)
            points->InsertNextPoint(p.x, p.y, p.z);
    }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetLines(lines);
    writePolyData(file, data);
}

SkeletonVoxels readSkeletonVoxels(const fs::path& file)
{
    const auto data = readPolyData(file);
    SkeletonVoxels paths;
    vtkNew<vtkIdList> ids;
    for (vtkIdType line = 0; line < data->GetNumberOfLines(); ++line) {
        data->GetLines()->GetCellAtId(line, ids);
        auto& path = paths.emplace_back();
        for (vtkIdType n = 0; n < ids->GetNumberOfIds(); ++n)
            path.push_back(pointOf(data, ids->GetId(n)));
    }
    return paths;
}

}  // namespace vicon::artefact
