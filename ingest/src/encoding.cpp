#include "encoding.h"

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcuid.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace vicon::ingest {
namespace {

constexpr std::array<std::string_view, 2> kJpeg2000{UID_JPEG2000LosslessOnlyTransferSyntax, UID_JPEG2000TransferSyntax};
constexpr std::array<std::string_view, 2> kJpegLs{UID_JPEGLSLosslessTransferSyntax, UID_JPEGLSLossyTransferSyntax};
/// Those that DCMTK's JPEG module decodes.
constexpr std::array<std::string_view, 6> kJpeg{UID_JPEGProcess1TransferSyntax,   UID_JPEGProcess2_4TransferSyntax,
                                                UID_JPEGProcess6_8TransferSyntax, UID_JPEGProcess10_12TransferSyntax,
                                                UID_JPEGProcess14TransferSyntax,  UID_JPEGProcess14SV1TransferSyntax};

bool isOneOf(const auto& syntaxes, std::string_view syntax)
{
    return std::find(syntaxes.begin(), syntaxes.end(), syntax) != syntaxes.end();
}

}  // namespace

bool isJpeg2000(const std::string& transfer_syntax)
{
    return isOneOf(kJpeg2000, transfer_syntax);
}

bool isRle(const std::string& transfer_syntax)
{
    return transfer_syntax == UID_RLELosslessTransferSyntax;
}

bool isDecodedByGdcm(const std::string& transfer_syntax)
{
    return isJpeg2000(transfer_syntax) || isOneOf(kJpegLs, transfer_syntax);
}

bool isDecodable(const std::string& transfer_syntax)
{
    return isRle(transfer_syntax) || isDecodedByGdcm(transfer_syntax) || isOneOf(kJpeg, transfer_syntax);
}

}  // namespace vicon::ingest
