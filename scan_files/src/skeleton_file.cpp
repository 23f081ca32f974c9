#include "vicon/scan_files/skeleton_file.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include "poly_data_file.h"
#include "vicon/core/error.h"

namespace fs = std::filesystem;

namespace vicon::scan_files {
namespace {

/// Array of a file without lines that is of an organ without a path; any other is damaged.
constexpr const char* kNoPath = "no_path";

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

void writeLines(const fs::path& file, const Skeleton& skeleton, const SkeletonTree& tree)
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
    if (!tree.empty()) {
        vtkNew<vtkIntArray> branch, parent, generation;
        branch->SetName("branch");
        parent->SetName("parent");
        generation->SetName("generation");
        for (std::size_t n = 0; n < tree.branches.size(); ++n) {
            branch->InsertNextValue(int(n));
            parent->InsertNextValue(tree.branches[n].parent);
            generation->InsertNextValue(tree.branches[n].generation);
        }
        for (vtkIntArray* array : {branch.Get(), parent.Get(), generation.Get()})
            data->GetCellData()->AddArray(array);
    }
    writePolyData(file, data);
}

/// The lines of a file, and what of them is a tree.
struct ReadLines {
    Skeleton skeleton;
    SkeletonTree tree;
};

ReadLines readLines(const fs::path& file)
{
    const auto data = readPolyData(file);
    if (data->GetNumberOfLines() == 0 && data->GetPointData()->GetArray(kNoPath))
        return {};
    auto* station = data->GetPointData()->GetArray("station_mm");
    auto* radius = data->GetPointData()->GetArray("radius_mm");
    auto* bridge = data->GetCellData()->GetArray("bridge");
    auto* parent = data->GetCellData()->GetArray("parent");
    auto* generation = data->GetCellData()->GetArray("generation");
    if (!station || !radius || !bridge || data->GetNumberOfLines() == 0 || !parent != !generation)
        throw Error(ErrorCode::bad_input, "is not a skeleton", file.string(), "run 'vicon work' to make it anew");
    ReadLines out;
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
        if (parent) {
            const double before = parent->GetTuple1(line);
            if (!(before >= -1 && before < double(line)))
                throw Error(ErrorCode::bad_input, "has a branch that comes before its parent", file.string());
            out.tree.branches.push_back(
                {int(before), int(std::clamp(generation->GetTuple1(line), 0.0, before + 1)), piece.points});
        }
        out.skeleton.pieces.push_back(std::move(piece));
    }
    return out;
}

}  // namespace

void writeSkeleton(const fs::path& file, const Skeleton& skeleton)
{
    writeLines(file, skeleton, {});
}

void writeSkeletonTree(const fs::path& file, const SkeletonTree& tree)
{
    writeLines(file, tree.allBranches(), tree);
}

void writeNoPath(const fs::path& file, const SkeletonPoint& widest)
{
    const auto points = doublePoints();
    points->InsertNextPoint(widest.position_mm.x, widest.position_mm.y, widest.position_mm.z);
    vtkNew<vtkDoubleArray> radius;
    radius->SetName("radius_mm");
    radius->InsertNextValue(widest.radius_mm);
    vtkNew<vtkIntArray> none;
    none->SetName(kNoPath);
    none->InsertNextValue(1);
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->GetPointData()->AddArray(radius);
    data->GetPointData()->AddArray(none);
    writePolyData(file, data);
}

Skeleton readSkeleton(const fs::path& file)
{
    ReadLines read = readLines(file);
    return read.tree.empty() ? std::move(read.skeleton) : read.tree.pathTo(read.tree.tips().front());
}

SkeletonTree readSkeletonTree(const fs::path& file)
{
    return readLines(file).tree;
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

}  // namespace vicon::scan_files
