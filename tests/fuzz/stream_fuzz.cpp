// A stream that passes the guard has the header's matrix; an RLE stream fills exactly its pixels or is refused.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "rle.h"
#include "stream_guard.h"
#include "vicon/core/error.h"

using namespace vicon::ingest;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size < 4)
        return 0;
    PixelFormat format;
    format.columns = 2 + data[0] % 62;
    format.rows = 2 + data[1] % 62;
    format.bits_allocated = data[2] % 2 ? 16 : 8;
    format.bits_stored = format.bits_allocated;
    format.high_bit = format.bits_stored - 1;
    const std::string_view stream(reinterpret_cast<const char*>(data) + 3, size - 3);
    (void)whyNotDecodable(stream, format, "1.2.840.10008.1.2.4.90");
    (void)whyNotDecodable(stream, format, "1.2.840.10008.1.2.4.80");
    (void)whyNotDecodable(stream, format, "1.2.840.10008.1.2.4.70");
    try {
        const auto pixels = decodeRle(stream, format);
        if (pixels.size() != std::size_t(format.columns * format.rows * format.bits_allocated / 8))
            std::abort();
    } catch (const vicon::Error&) {
    }
    return 0;
}
