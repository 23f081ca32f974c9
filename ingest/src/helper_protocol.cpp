#include "helper_protocol.h"

namespace vicon::ingest {
namespace {

/// No scanner's frame takes so long; a stream that does is made to.
constexpr double kSecondsAtLeast = 4, kSecondsPerPixel = 1e-6;

}  // namespace

HelperRequest decodeRequest(const PixelFormat& format, const std::string& transfer_syntax, std::size_t stream_bytes)
{
    HelperRequest request;
    request.kind = HelperRequest::Kind::decode;
    request.cpu_seconds =
        std::uint32_t(kSecondsAtLeast + kSecondsPerPixel * double(format.rows) * double(format.columns));
    request.rows = format.rows;
    request.columns = format.columns;
    request.bits_allocated = format.bits_allocated;
    request.bits_stored = format.bits_stored;
    request.high_bit = format.high_bit;
    request.is_signed = format.is_signed ? 1 : 0;
    transfer_syntax.copy(request.transfer_syntax, sizeof request.transfer_syntax - 1);
    request.bytes = stream_bytes;
    return request;
}

PixelFormat pixelFormatOf(const HelperRequest& request)
{
    PixelFormat format;
    format.rows = request.rows;
    format.columns = request.columns;
    format.bits_allocated = request.bits_allocated;
    format.bits_stored = request.bits_stored;
    format.high_bit = request.high_bit;
    format.is_signed = request.is_signed != 0;
    return format;
}

}  // namespace vicon::ingest
