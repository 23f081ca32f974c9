#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "vicon/core/cell_surface.h"

namespace vicon::scan_files {

/// Writes `cells.vtp`: polys with point normals and the cell array `segment` (uint16).
void writeCells(const std::filesystem::path& file, const CellSurface& surface);
/// Throws Error{not_found} or Error{bad_input}.
CellSurface readCells(const std::filesystem::path& file);

}  // namespace vicon::scan_files
