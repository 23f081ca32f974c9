#include "vicon/scan_files/cells_file.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedShortArray.h>

#include <algorithm>

#include "poly_data_file.h"
#include "vicon/core/error.h"

namespace fs = std::filesystem;

namespace vicon::scan_files {
namespace {

vtkNew<vtkFloatArray> triples(const std::vector<float>& values, const char* name)
{
    vtkNew<vtkFloatArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(3);
    array->SetNumberOfTuples(vtkIdType(values.size() / 3));
    std::copy(values.begin(), values.end(), array->GetPointer(0));
    return array;
}

/// @tparam Usual the kind of array that writeCells() writes; others are read one value at a time
template <class Usual, class T>
void copyValues(vtkDataArray* from, std::vector<T>& to)
{
    const vtkIdType count = from->GetNumberOfValues();
    if (auto* usual = Usual::FastDownCast(from)) {
        to.assign(usual->GetPointer(0), usual->GetPointer(0) + count);
        return;
    }
    const int components = from->GetNumberOfComponents();
    to.resize(std::size_t(count));
    for (vtkIdType n = 0; n < count; ++n)
        to[std::size_t(n)] = T(from->GetComponent(n / components, int(n % components)));
}

}  // namespace

void writeCells(const fs::path& file, const CellSurface& surface)
{
    vtkNew<vtkPoints> points;
    points->SetData(triples(surface.points_mm, "Points"));
    const auto count = vtkIdType(surface.triangleCount());
    vtkNew<vtkTypeInt32Array> corners, offsets;
    corners->SetNumberOfValues(count * 3);
    std::copy(surface.triangles.begin(), surface.triangles.end(), corners->GetPointer(0));
    offsets->SetNumberOfValues(count + 1);
    for (vtkIdType n = 0; n <= count; ++n)
        offsets->SetValue(n, int(3 * n));
    vtkNew<vtkCellArray> polys;
    polys->SetData(offsets, corners);
    vtkNew<vtkUnsignedShortArray> segment;
    segment->SetName("segment");
    segment->SetNumberOfValues(count);
    std::copy(surface.segment.begin(), surface.segment.end(), segment->GetPointer(0));

    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetPolys(polys);
    data->GetPointData()->SetNormals(triples(surface.normals, "Normals"));
    data->GetCellData()->AddArray(segment);
    writePolyData(file, data);
}

CellSurface readCells(const fs::path& file)
{
    const auto data = readPolyData(file);
    auto* normals = data->GetPointData()->GetNormals();
    auto* segment = data->GetCellData()->GetArray("segment");
    const bool triangles = data->GetPolys() && data->GetPolys()->GetMaxCellSize() <= 3 &&
                           data->GetPolys()->GetNumberOfConnectivityIds() == 3 * data->GetPolys()->GetNumberOfCells();
    if (!normals || normals->GetNumberOfComponents() != 3 || !segment || segment->GetNumberOfComponents() != 1 ||
        !triangles || data->GetNumberOfCells() != data->GetPolys()->GetNumberOfCells())
        throw Error(ErrorCode::bad_input, "is not a surface of cells", file.string(),
                    "run 'vicon work' to make it anew");
    CellSurface surface;
    copyValues<vtkFloatArray>(data->GetPoints()->GetData(), surface.points_mm);
    copyValues<vtkFloatArray>(normals, surface.normals);
    copyValues<vtkTypeInt32Array>(data->GetPolys()->GetConnectivityArray(), surface.triangles);
    copyValues<vtkUnsignedShortArray>(segment, surface.segment);
    return surface;
}

}  // namespace vicon::scan_files
