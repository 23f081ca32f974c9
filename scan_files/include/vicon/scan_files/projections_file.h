#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "vicon/core/projection.h"

namespace vicon::scan_files {

/// Writes each as NAME.png into `folder` (made when absent), and projections.json:
/// {"projections":[{"name","file","width","height","pixel_mm","right":[x,y,z],"down":[x,y,z],"first_pixel_mm":[x,y,z]}]}
/// so that column = (p - first_pixel_mm) . right / pixel_mm. The PNG files carry the same as the text "vicon:mapping".
/// Throws Error{store}.
void writeProjections(const std::filesystem::path& folder, std::span<const Projection> projections);

/// Reads one of them back. Throws Error{not_found}, or Error{bad_input} when the description or the picture is damaged
/// or one does not fit the other.
Projection readProjection(const std::filesystem::path& folder, const std::string& name);

}  // namespace vicon::scan_files
