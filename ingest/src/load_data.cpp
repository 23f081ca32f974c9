#include "load_data.h"

#include <dcmtk/dcmdata/dcistrmb.h>

#include <cstdint>
#include <exception>
#include <string>

#include "structure_scan.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/dicom/load_file.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

/// Throws Error.
std::uint64_t bytesBehindEnd(const fs::path& file)
{
    return scanStructure(file).trailing_bytes;
}

}  // namespace

bool hasBytesBehindItsEnd(const fs::path& file)
{
    try {
        return bytesBehindEnd(file) > 0;
    } catch (const Error&) {
        return false;
    }
}

OFCondition loadData(DcmFileFormat& format, const fs::path& file, Uint32 largest_in_memory_bytes)
try {
    const std::uint64_t behind = bytesBehindEnd(file);
    if (behind == 0)
        return loadFile(format, file, largest_in_memory_bytes);
    const std::string bytes = readFile(file);
    if (bytes.size() < behind)
        return EC_CorruptedData;
    DcmInputBufferStream in;
    in.setBuffer(bytes.data(), offile_off_t(bytes.size() - behind));
    in.setEos();
    format.transferInit();
    const OFCondition read = format.read(in, EXS_Unknown, EGL_noChange, DCM_MaxReadLength);
    format.transferEnd();
    return read;
} catch (const std::exception&) {
    return EC_CorruptedData;
}

}  // namespace vicon::ingest
