#include "same_object.h"

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcostrmb.h>
#include <dcmtk/dcmdata/dctk.h>

#include <optional>
#include <string>

#include "load_data.h"
#include "vicon/core/file.h"
#include "vicon/dicom/dicom_setup.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

constexpr Uint32 kWritingBlock = 1 << 16;

/// The pixels' encoding that both must share; uncompressed ones are written alike.
E_TransferSyntax commonSyntax(E_TransferSyntax syntax)
{
    const DcmXfer xfer(syntax);
    return xfer.isEncapsulated() ? syntax : EXS_LittleEndianExplicit;
}

/// The data set in one form: explicit lengths, no group lengths, no padding. Nothing when it cannot be read.
std::optional<std::string> canonical(const fs::path& file, E_TransferSyntax& syntax)
{
    DcmFileFormat format;
    if (loadData(format, file).bad())
        return {};
    DcmDataset& dataset = *format.getDataset();
    syntax = commonSyntax(dataset.getOriginalXfer());
    delete dataset.remove(DCM_DataSetTrailingPadding);
    std::string bytes;
    std::string block(kWritingBlock, '\0');
    DcmOutputBufferStream out(block.data(), block.size());
    dataset.transferInit();
    OFCondition written = EC_StreamNotifyClient;
    while (written == EC_StreamNotifyClient) {
        written = dataset.write(out, syntax, EET_ExplicitLength, nullptr, EGL_withoutGL, EPD_withoutPadding);
        void* buffer = nullptr;
        offile_off_t length = 0;
        out.flushBuffer(buffer, length);
        bytes.append(static_cast<const char*>(buffer), std::size_t(length));
    }
    dataset.transferEnd();
    return written.good() ? std::optional(sha256(bytes)) : std::nullopt;
}

}  // namespace

bool isSameObject(const fs::path& a, const fs::path& b)
{
    setUpDicom();
    E_TransferSyntax of_a = EXS_Unknown, of_b = EXS_Unknown;
    const auto first = canonical(a, of_a), second = canonical(b, of_b);
    return first && second && of_a == of_b && *first == *second;
}

}  // namespace vicon::ingest
