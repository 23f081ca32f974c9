#include "poly_data_file.h"

#include <vtkNew.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon::scan_files {

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
    if (!reader->CanReadFile(file.c_str()))
        throw Error(ErrorCode::bad_input, "not a .vtp file", file.string(), "run 'vicon work' to make it anew");
    reader->SetFileName(file.c_str());
    reader->Update();
    if (reader->GetErrorCode() != 0)
        throw Error(ErrorCode::bad_input, "is damaged", file.string(), "run 'vicon work' to make it anew");
    return reader->GetOutput();
}

}  // namespace vicon::scan_files
