#include "poly_data_file.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArrayRange.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <new>

#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vtp_header.h"

namespace fs = std::filesystem;

namespace vicon::scan_files {
namespace {

/// Whether every cell's corners are points that are there.
bool refersTo(vtkCellArray* cells, vtkIdType points)
{
    if (!cells || cells->GetNumberOfCells() == 0)
        return true;
    vtkDataArray* offsets = cells->GetOffsetsArray();
    vtkDataArray* corners = cells->GetConnectivityArray();
    if (offsets->GetComponent(0, 0) != 0 ||
        offsets->GetComponent(cells->GetNumberOfCells(), 0) != double(corners->GetNumberOfValues()))
        return false;
    const auto ends = vtk::DataArrayValueRange<1>(offsets);
    if (!std::is_sorted(ends.begin(), ends.end()))
        return false;
    const auto ids = vtk::DataArrayValueRange<1>(corners);
    return std::all_of(ids.begin(), ids.end(), [&](double id) { return id >= 0 && id < double(points); });
}

bool haveValuesFor(vtkFieldData* arrays, vtkIdType count)
{
    for (int n = 0; n < arrays->GetNumberOfArrays(); ++n) {
        const vtkAbstractArray* array = arrays->GetAbstractArray(n);
        if (!array || array->GetNumberOfTuples() != count)
            return false;
    }
    return true;
}

bool holdsTogether(vtkPolyData* data)
{
    const vtkIdType points = data->GetNumberOfPoints();
    for (vtkCellArray* cells : {data->GetVerts(), data->GetLines(), data->GetPolys(), data->GetStrips()})
        if (!refersTo(cells, points))
            return false;
    return data->GetPoints() && haveValuesFor(data->GetPointData(), points) &&
           haveValuesFor(data->GetCellData(), data->GetNumberOfCells());
}

}  // namespace

void writePolyData(const fs::path& file, vtkPolyData* data)
{
    replaceFile(file, [&](const fs::path& temporary) {
        vtkNew<vtkXMLPolyDataWriter> writer;
        writer->SetFileName(temporary.c_str());
        writer->SetInputData(data);
        writer->SetDataModeToAppended();
        writer->EncodeAppendedDataOff();
        writer->SetCompressorTypeToNone();
        if (!writer->Write() || writer->GetErrorCode() != 0)
            throw Error(ErrorCode::store, "cannot be written", file.string(), "check the disk's free space");
    });
}

vtkSmartPointer<vtkPolyData> readPolyData(const fs::path& file)
{
    if (!fs::exists(file))
        throw Error(ErrorCode::not_found, "no such file", file.string(), "run 'vicon work' to make it");
    vtkNew<vtkXMLPolyDataReader> reader;
    if (!isSoundVtp(file) || !reader->CanReadFile(file.c_str()))
        throw Error(ErrorCode::bad_input, "not a .vtp file", file.string(), "run 'vicon work' to make it anew");
    reader->SetFileName(file.c_str());
    bool fits = true;
    try {
        reader->Update();
    } catch (const std::bad_alloc&) {  // for what the file claims to hold
        fits = false;
    }
    if (!fits || reader->GetErrorCode() != 0 || !holdsTogether(reader->GetOutput()))
        throw Error(ErrorCode::bad_input, "is damaged", file.string(), "run 'vicon work' to make it anew");
    return reader->GetOutput();
}

}  // namespace vicon::scan_files
