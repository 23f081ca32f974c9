#include "element_coding.h"

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctag.h>
#include <dcmtk/dcmdata/dcxfer.h>

#include <algorithm>

namespace vicon::ingest {
namespace {

/// DCMTK finds a transfer syntax by its name, too, and where none is said one of its own that has no UID.
std::optional<DcmXfer> knownByUid(const std::string& transfer_syntax)
{
    const DcmXfer known(transfer_syntax.c_str());
    if (transfer_syntax.empty() || known.getXfer() == EXS_Unknown || transfer_syntax != known.getXferID())
        return {};
    return known;
}

}  // namespace

std::optional<Coding> codingOf(const std::string& transfer_syntax)
{
    const auto known = knownByUid(transfer_syntax);
    if (!known || known->getStreamCompression() != ESC_none)
        return {};
    return Coding{bool(known->isExplicitVR()), bool(known->isBigEndian())};
}

bool isDeflated(const std::string& transfer_syntax)
{
    const auto known = knownByUid(transfer_syntax);
    return known && known->getStreamCompression() != ESC_none;
}

bool mayEndElsewhere(std::uint32_t tag, const unsigned char* begin, std::size_t count)
{
    constexpr std::size_t kItemHead = 8;
    constexpr unsigned char kLowByte = kDelimiterGroup & 0xff;
    if (count == 0 || begin[0] != kLowByte || (count > 1 && numberIn(begin, 2, false) != kDelimiterGroup))
        return false;
    if (count >= kItemHead && tagIn(begin, false) == kItem)
        return false;
    const DcmEVR type = DcmTag(Uint16(tag >> 16), Uint16(tag & 0xffff)).getEVR();
    return type == EVR_SQ || type == EVR_UN || type == EVR_UNKNOWN;
}

}  // namespace vicon::ingest
