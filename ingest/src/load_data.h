#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcfilefo.h>

#include <filesystem>

namespace vicon::ingest {

/// Whether bytes that are no element follow a file's last one.
bool hasBytesBehindItsEnd(const std::filesystem::path& file);

/// Reads a DICOM file up to the end of its data: bytes behind it, which import accepts, are left out, and all values
/// then lie in memory. Otherwise as loadFile() does.
/// @param largest_in_memory_bytes larger values stay in the file until they are asked for
OFCondition loadData(DcmFileFormat& format, const std::filesystem::path& file,
                     Uint32 largest_in_memory_bytes = DCM_MaxReadLength);

}  // namespace vicon::ingest
