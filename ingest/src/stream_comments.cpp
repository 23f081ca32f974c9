#include "stream_comments.h"

#include <algorithm>
#include <cstddef>

namespace vicon::ingest {
namespace {

// Second bytes of markers: ITU-T T.81 table B.1, T.87, T.800 table A.2.
constexpr std::uint8_t kMark = 0xFF, kJpegStart = 0xD8, kJpeg2000Start = 0x4F;
constexpr std::uint8_t kScan = 0xDA, kEnd = 0xD9, kTile = 0x90, kComment = 0xFE, kComment2000 = 0x64;
constexpr std::uint8_t kFirstApplication = 0xE0, kLastApplication = 0xEF;
constexpr std::uint8_t kJfif = 0xE0, kColourOfLs = 0xE8, kAdobe = 0xEE;  // what decoders read

bool isTalk(std::uint8_t marker, bool jpeg2000)
{
    if (jpeg2000)
        return marker == kComment2000;
    if (marker == kComment)
        return true;
    return marker >= kFirstApplication && marker <= kLastApplication && marker != kJfif && marker != kColourOfLs &&
           marker != kAdobe;
}

}  // namespace

void blankComments(std::span<std::uint8_t> stream)
{
    constexpr std::size_t kMarker = 2, kLength = 2, kKindOfComment2000 = 2;
    if (stream.size() < kMarker || stream[0] != kMark || (stream[1] != kJpegStart && stream[1] != kJpeg2000Start))
        return;
    const bool jpeg2000 = stream[1] == kJpeg2000Start;
    for (std::size_t at = kMarker; at + kMarker + kLength <= stream.size() && stream[at] == kMark;) {
        const std::uint8_t marker = stream[at + 1];
        if (marker == kMark) {  // a byte of filling
            ++at;
            continue;
        }
        if (marker == kScan || marker == kEnd || marker == kTile)
            return;
        const std::size_t length = std::size_t(stream[at + 2]) << 8 | stream[at + 3];
        const std::size_t end = std::min(stream.size(), at + kMarker + length);
        const std::size_t text = at + kMarker + kLength + (jpeg2000 ? kKindOfComment2000 : 0);
        if (isTalk(marker, jpeg2000) && text < end)
            std::fill(stream.begin() + std::ptrdiff_t(text), stream.begin() + std::ptrdiff_t(end), std::uint8_t(0));
        at += kMarker + std::max(length, kLength);
    }
}

}  // namespace vicon::ingest
