#include "vicon/dicom/load_file.h"

#include <exception>

namespace vicon {

OFCondition loadFile(DcmFileFormat& format, const std::filesystem::path& file, Uint32 largest_in_memory_bytes,
                     std::optional<DcmTagKey> until)
try {
    if (until)
        return format.loadFileUntilTag(file.c_str(), EXS_Unknown, EGL_noChange, largest_in_memory_bytes, ERM_autoDetect,
                                       *until);
    return format.loadFile(file.c_str(), EXS_Unknown, EGL_noChange, largest_in_memory_bytes);
} catch (const std::exception&) {
    return EC_CorruptedData;
}

}  // namespace vicon
