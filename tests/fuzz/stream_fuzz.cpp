// The guards of the codecs: a stream that passes has the header's matrix, and the decoder makes exactly its pixels of
// it or says why not; an RLE stream fills exactly its pixels or is refused.
#include <string_view>

#include "helper.h"
#include "memory_file.h"
#include "rle.h"
#include "stream_encodings.h"
#include "stream_guard.h"
#include "vicon/core/error.h"

using namespace vicon;
using namespace vicon::ingest;

namespace {

std::vector<char> decoded(std::string_view stream, const PixelFormat& format, const std::string& syntax)
{
    if (syntax == fuzz::kRle)
        return decodeRle(stream, format);
    return decodeInHelper(stream, format, syntax);
}

}  // namespace

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
    const std::string syntax(fuzz::kStreamEncodings[data[3] % std::size(fuzz::kStreamEncodings)]);
    const std::string_view stream(reinterpret_cast<const char*>(data) + 4, size - 4);
    if (syntax != fuzz::kRle && !whyNotDecodable(stream, format, syntax).empty())
        return 0;
    try {
        const auto pixels = decoded(stream, format, syntax);
        fuzz::require(pixels.size() == std::size_t(format.columns * format.rows * format.bits_allocated / 8));
    } catch (const Error& e) {
        fuzz::require(e.code() == ErrorCode::bad_input);
    }
    return 0;
}
