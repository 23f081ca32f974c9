#include "stream_guard.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "encoding.h"

namespace vicon::ingest {
namespace {

/// What a stream says of its picture.
struct Picture {
    std::uint64_t columns = 0, rows = 0;
    unsigned bits = 0, components = 0;
    bool is_signed = false;  ///< JPEG and JPEG-LS do not say
};

/// Either a picture or why there is none.
struct Reading {
    std::optional<Picture> picture;
    std::string why;
};

Reading unreadable(std::string why)
{
    return {{}, std::move(why)};
}

constexpr const char* kCutOff = "its compressed pixels are cut off";

/// Big-endian numbers of a stream; what lies behind its end reads as nothing.
class Bytes {
public:
    explicit Bytes(std::string_view bytes) : bytes_(bytes) {}
    std::size_t size() const { return bytes_.size(); }
    std::optional<std::uint32_t> number(std::size_t at, std::size_t count) const
    {
        if (at > bytes_.size() || bytes_.size() - at < count)
            return {};
        std::uint32_t value = 0;
        for (std::size_t n = 0; n < count; ++n)
            value = value << 8 | std::uint8_t(bytes_[at + n]);
        return value;
    }
    std::uint32_t sure(std::size_t at, std::size_t count) const { return number(at, count).value_or(0); }
    bool hasFrom(std::size_t at, std::string_view what) const
    {
        const std::size_t last = bytes_.rfind(what);  // an end is looked for, and stands at the end
        return last != std::string_view::npos && last >= at;
    }

private:
    std::string_view bytes_;
};

// JPEG 2000, ISO/IEC 15444-1 annex A.
constexpr std::uint32_t kSoc = 0xff4f, kSiz = 0xff51, kSot = 0xff90, kEoc = 0xffd9;
constexpr std::size_t kSizEnd = 45;  ///< of the first component's description
constexpr std::size_t kSotBytes = 12;

struct Tiles {
    std::uint64_t count = 0;
    std::size_t first_part = 0;  ///< where the first tile-part begins
};

/// Every tile has to be there, complete: a decoder leaves out what is missing, and its picture has holes.
std::string checkTiles(const Bytes& bytes, const Tiles& tiles)
{
    std::vector<bool> seen(tiles.count);
    std::uint64_t found = 0;
    std::size_t at = tiles.first_part;
    while (bytes.number(at, 2) == kSot) {
        if (!bytes.number(at, kSotBytes - 8) || at + kSotBytes > bytes.size())
            return kCutOff;
        const std::uint32_t tile = bytes.sure(at + 4, 2), length = bytes.sure(at + 6, 4);
        if (tile >= tiles.count)
            return "its compressed stream has a tile outside its image";
        found += seen[tile] ? 0 : 1;
        seen[tile] = true;
        if (length == 0)  // until the end of the stream
            break;
        if (length < kSotBytes || length > bytes.size() - at)
            return kCutOff;
        at += length;
    }
    return found == tiles.count ? std::string() : kCutOff;
}

Reading readJpeg2000(const Bytes& bytes)
{
    if (bytes.number(0, 2) != kSoc || bytes.number(2, 2) != kSiz)
        return unreadable("its compressed pixels are no JPEG 2000 stream");
    if (bytes.size() < kSizEnd)
        return unreadable(kCutOff);
    constexpr std::uint64_t kMostTiles = 65535;
    const std::uint64_t columns = bytes.sure(8, 4), rows = bytes.sure(12, 4);
    const std::uint64_t tile_columns = bytes.sure(24, 4), tile_rows = bytes.sure(28, 4);
    const bool offset = bytes.sure(16, 4) || bytes.sure(20, 4) || bytes.sure(32, 4) || bytes.sure(36, 4);
    if (offset || tile_columns == 0 || tile_rows == 0 || bytes.sure(43, 1) != 1 || bytes.sure(44, 1) != 1)
        return unreadable("its JPEG 2000 stream has an offset, no tiles or coarser samples");
    const std::uint64_t across = (columns + tile_columns - 1) / tile_columns, down = (rows + tile_rows - 1) / tile_rows;
    if (across == 0 || down == 0 || across > kMostTiles || down > kMostTiles || across * down > kMostTiles)
        return unreadable("its JPEG 2000 stream has more tiles than the standard allows");
    std::size_t at = 2;
    for (std::uint32_t marker = kSiz; marker != kSot; marker = bytes.sure(at, 2)) {
        const auto length = bytes.number(at + 2, 2);
        if (marker < 0xff00 || marker == kEoc || !length || *length < 2)
            return unreadable(kCutOff);
        at += 2 + *length;
    }
    if (std::string why = checkTiles(bytes, {across * down, at}); !why.empty())
        return unreadable(std::move(why));
    constexpr std::uint32_t kSigned = 0x80;
    const std::uint32_t sample = bytes.sure(42, 1);
    return {Picture{columns, rows, (sample & ~kSigned) + 1, bytes.sure(40, 2), (sample & kSigned) != 0}, {}};
}

/// Whether a marker begins a frame of a process that is decoded: sequential, progressive or lossless Huffman, JPEG-LS.
bool beginsFrame(std::uint32_t marker)
{
    constexpr std::array<std::uint32_t, 5> kFrames{0xffc0, 0xffc1, 0xffc2, 0xffc3, 0xfff7};
    return std::find(kFrames.begin(), kFrames.end(), marker) != kFrames.end();
}

/// JPEG (ITU-T T.81 annex B) and JPEG-LS (T.87 annex C).
Reading readJpeg(const Bytes& bytes)
{
    constexpr std::uint32_t kSoi = 0xffd8, kSos = 0xffda, kEoi = 0xffd9, kSof55 = 0xfff7;  // the last: of JPEG-LS
    if (bytes.number(0, 2) != kSoi)
        return unreadable("its compressed pixels are no JPEG stream");
    for (std::size_t at = 2;;) {
        if (bytes.number(at, 2) == 0xffff) {  // fill bytes may stand before a marker
            ++at;
            continue;
        }
        const auto marker = bytes.number(at, 2);
        const auto length = bytes.number(at + 2, 2);
        if (!marker || !length)
            return unreadable(kCutOff);
        if (*marker < 0xffc0 || *marker == kSos || *marker == kEoi || *length < 2)
            return unreadable("its JPEG stream does not say how large its picture is");
        if (beginsFrame(*marker)) {
            // A decoder of JPEG-LS that finds no end may read on for seconds; in its data no 0xff stands before 0xd9.
            if (!bytes.number(at + 8, 2) || (*marker == kSof55 && !bytes.hasFrom(at, "\xff\xd9")))
                return unreadable(kCutOff);
            return {Picture{bytes.sure(at + 7, 2), bytes.sure(at + 5, 2), bytes.sure(at + 4, 1), bytes.sure(at + 9, 1)},
                    {}};
        }
        at += 2 + *length;
    }
}

std::string disagreement(const Picture& picture, const PixelFormat& format)
{
    const auto size = [](std::uint64_t columns, std::uint64_t rows) {
        return std::to_string(columns) + " x " + std::to_string(rows);
    };
    if (picture.columns != std::uint64_t(format.columns) || picture.rows != std::uint64_t(format.rows))
        return "its compressed stream holds " + size(picture.columns, picture.rows) + " pixels, its header says " +
               size(std::uint64_t(format.columns), std::uint64_t(format.rows));
    if (picture.components != 1)
        return "its compressed stream holds " + std::to_string(picture.components) + " components, its header says 1";
    if (picture.bits < 1 || (picture.bits + 7) / 8 != unsigned(format.bits_allocated) / 8)
        return "its compressed stream holds samples of " + std::to_string(picture.bits) +
               " bits, its header allocates " + std::to_string(format.bits_allocated);
    // The other way round the bits are those of the header, and mean what it says.
    if (picture.is_signed && !format.is_signed)
        return "its compressed stream holds signed samples, its header says unsigned";
    return {};
}

Reading read(std::string_view stream, const std::string& transfer_syntax)
{
    return isJpeg2000(transfer_syntax) ? readJpeg2000(Bytes(stream)) : readJpeg(Bytes(stream));
}

}  // namespace

int sampleBits(std::string_view stream, const std::string& transfer_syntax)
{
    const Reading reading = read(stream, transfer_syntax);
    return reading.picture ? int(reading.picture->bits) : 0;
}

std::string whyNotDecodable(std::string_view stream, const PixelFormat& format, const std::string& transfer_syntax)
{
    const Reading reading = read(stream, transfer_syntax);
    return reading.picture ? disagreement(*reading.picture, format) : reading.why;
}

}  // namespace vicon::ingest
