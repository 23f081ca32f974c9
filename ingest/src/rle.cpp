#include "rle.h"

#include <cstdint>

#include "vicon/core/error.h"

namespace vicon::ingest {
namespace {

constexpr std::size_t kHeaderBytes = 64, kMostSegments = 15;
constexpr const char* kTooMany = "its RLE stream holds more pixels than its header says";
/// Bytes that may stand behind the last run: zeros to an even length, and runs of nothing.
constexpr std::string_view kPadding("\0\x80", 2);

[[noreturn]] void brokenStream(const char* why)
{
    throw Error(ErrorCode::bad_input, why);
}

std::uint32_t littleEndian(std::string_view stream, std::size_t at)
{
    std::uint32_t value = 0;
    for (std::size_t n = 4; n-- > 0;)
        value = value << 8 | std::uint8_t(stream[at + n]);
    return value;
}

/// Writes every `stride`-th byte of `out`, `count` of them, from the runs of one segment. Each row is packed by itself,
/// and nothing else in the stream tells how long its rows are.
void unpack(std::string_view segment, char* out, std::size_t stride, std::size_t count, std::size_t columns)
{
    std::size_t at = 0, done = 0;
    while (done < count) {
        if (at >= segment.size())
            brokenStream("its compressed pixels are cut off");
        const auto byte = static_cast<unsigned char>(segment[at++]);
        const int control = byte < 128 ? byte : byte - 256;  // two's complement
        if (control == -128)
            continue;
        const bool repeated = control < 0;
        const auto length = std::size_t(repeated ? 1 - control : 1 + control);
        if (length > count - done)
            brokenStream(kTooMany);
        if (done % columns + length > columns)
            brokenStream("its RLE stream has runs that cross its rows: it is of another matrix than its header says");
        if (segment.size() - at < (repeated ? 1 : length))
            brokenStream("its compressed pixels are cut off");
        for (std::size_t n = 0; n < length; ++n)
            out[(done + n) * stride] = segment[at + (repeated ? 0 : n)];
        done += length;
        at += repeated ? 1 : length;
    }
    if (segment.find_first_not_of(kPadding, at) != std::string_view::npos)
        brokenStream(kTooMany);
}

}  // namespace

std::vector<char> decodeRle(std::string_view stream, const PixelFormat& format)
{
    const auto bytes = std::size_t(format.bits_allocated / 8);
    const std::size_t pixels = std::size_t(format.columns) * std::size_t(format.rows);
    if (stream.size() < kHeaderBytes)
        brokenStream("its compressed pixels are cut off");
    const std::size_t segments = littleEndian(stream, 0);
    if (segments > kMostSegments || segments != bytes)
        brokenStream("its RLE stream has another number of segments than its pixels have bytes");
    std::vector<char> out(pixels * bytes);
    for (std::size_t n = 0; n < segments; ++n) {
        const std::size_t begin = littleEndian(stream, 4 + 4 * n);
        const std::size_t end = n + 1 < segments ? littleEndian(stream, 8 + 4 * n) : stream.size();
        if (begin < kHeaderBytes || begin > end || end > stream.size())
            brokenStream("its RLE stream has a segment outside of itself");
        unpack(stream.substr(begin, end - begin), out.data() + (segments - 1 - n), segments, pixels,
               std::size_t(format.columns));
    }
    return out;
}

}  // namespace vicon::ingest
