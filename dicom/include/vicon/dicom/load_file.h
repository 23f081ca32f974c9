#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcfilefo.h>

#include <filesystem>
#include <optional>

namespace vicon {

/// Reads a DICOM file as DCMTK does. What DCMTK throws is a bad condition, too: its parser makes texts of values that
/// a damaged file does not hold.
/// @param largest_in_memory_bytes larger values stay in the file until they are asked for
/// @param until nothing from this element on is read
OFCondition loadFile(DcmFileFormat& format, const std::filesystem::path& file,
                     Uint32 largest_in_memory_bytes = DCM_MaxReadLength, std::optional<DcmTagKey> until = {});

}  // namespace vicon
