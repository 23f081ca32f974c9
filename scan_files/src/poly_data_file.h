#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <filesystem>

namespace vicon::scan_files {

/// Writes a .vtp (appended raw binary, uncompressed: reading is what a radiologist waits for), by replaceFile().
void writePolyData(const std::filesystem::path& file, vtkPolyData* data);
/// What was read holds together: cells have points that are there, and arrays a value for each point or cell.
/// Throws Error{not_found} or Error{bad_input}.
vtkSmartPointer<vtkPolyData> readPolyData(const std::filesystem::path& file);

}  // namespace vicon::scan_files
