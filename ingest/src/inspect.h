#pragma once

#include <filesystem>

#include "image_object.h"
#include "vicon/ingest/import.h"

namespace vicon::ingest {

/// Finds out what a file is, and reads the header of a CT object. Never throws for what a file contains: a file that
/// cannot be used is refused with the reason. The pixels are not decoded, only their presence is checked.
/// Does not compute the file's hash.
Inspection inspectFile(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace vicon::ingest
