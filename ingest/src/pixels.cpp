#include "pixels.h"

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcfcache.h>
#include <dcmtk/dcmdata/dcpixel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "compressed_frames.h"
#include "dataset.h"
#include "encoding.h"
#include "helper.h"
#include "rle.h"
#include "stream_guard.h"
#include "vicon/core/error.h"
#include "vicon/core/volume.h"
#include "vicon/dicom/dicom_setup.h"
#include "vicon/dicom/load_file.h"

namespace vicon::ingest {
namespace {

/// No tissue, and no air however noisy, is this light: what is below was not measured, whether or not the object
/// declares its padding value. (GE's -2000, the -3024 that a -2000 becomes with the usual intercept.)
constexpr double kLightest_hu = -1500;

[[noreturn]] void failed(const std::string& why)
{
    throw Error(ErrorCode::bad_input, why);
}

/// A measured density as it is stored: never the one that stands for padding.
std::int16_t measured(double hu)
{
    const auto stored = std::int16_t(std::lround(std::min(hu, double(std::numeric_limits<std::int16_t>::max()))));
    return stored == kPaddingHu ? std::int16_t(kPaddingHu + 1) : stored;
}

/// Where the stored bits begin in a pixel as it lies in memory.
int shiftOf(const PixelFormat& format)
{
    return format.high_bit + 1 - format.bits_stored;
}

/// A density for each 16-bit pattern of a stored pixel.
std::vector<std::int16_t> densityTable(const PixelFormat& format, const Slice& slice, int shift)
{
    constexpr std::size_t kPatterns = 65536;
    std::vector<std::int16_t> table(kPatterns);
    const int range = 1 << format.bits_stored;
    for (std::size_t pattern = 0; pattern < kPatterns; ++pattern) {
        int stored = (int(pattern) >> shift) & (range - 1);
        if (format.is_signed && stored >= range / 2)
            stored -= range;
        const bool padding = (format.padding_cell == pattern) ||
                             (format.padding && stored >= format.padding->first && stored <= format.padding->second);
        const double hu = slice.slope * stored + slice.intercept;
        table[pattern] = padding || hu < kLightest_hu ? kPaddingHu : measured(hu);
    }
    return table;
}

}  // namespace

struct FrameDecoder::Opened {
    DcmFileFormat format;
    DcmFileCache cache;
    DcmPixelData* pixels = nullptr;
    std::optional<CompressedFrames> frames;
    std::vector<std::int16_t> table;
    double table_slope = 0, table_intercept = 0;
    int shift = 0, table_shift = 0;

    /// A frame of compressed pixels. What its stream says is looked at first, whoever asks.
    std::vector<char> decompressed(const ImageObject& object, int frame)
    {
        if (!frames)
            frames.emplace(*pixels, object.transfer_syntax, object.pixels.frames);
        const std::string stream = frames->stream(frame);
        if (isRle(object.transfer_syntax))
            return decodeRle(stream, object.pixels);
        if (const std::string why = whyNotDecodable(stream, object.pixels, object.transfer_syntax); !why.empty())
            failed(why);
        // A stream of no more bits than are stored holds the values themselves, whichever bit the header names.
        if (sampleBits(stream, object.transfer_syntax) <= object.pixels.bits_stored)
            shift = 0;
        return decodeInHelper(stream, object.pixels, object.transfer_syntax);
    }

    std::vector<char> decoded(const ImageObject& object, int frame)
    {
        const PixelFormat& f = object.pixels;
        shift = shiftOf(f);
        if (DcmXfer(object.transfer_syntax.c_str()).isEncapsulated())
            return decompressed(object, frame);
        const std::size_t needed = std::size_t(f.rows) * std::size_t(f.columns) * std::size_t(f.bits_allocated / 8);
        // By the matrix that was read at import: of frames DCMTK would look it up by itself, in fewer ways.
        const std::uint64_t at = std::uint64_t(frame) * needed;
        std::vector<char> bytes(needed);
        const OFCondition done = at + needed > std::numeric_limits<Uint32>::max()
                                     ? EC_IllegalParameter
                                     : pixels->getPartialValue(bytes.data(), Uint32(at), Uint32(needed), &cache);
        if (done.bad())
            failed("its pixels cannot be read (" + std::string(done.text()) + ")");
        return bytes;
    }
};

FrameDecoder::FrameDecoder(const ImageObject& object) : object_(object), opened_(std::make_unique<Opened>())
{
    setUpDicom();
    DcmElement* element = nullptr;
    const OFCondition loaded = loadFile(opened_->format, object.file, kLargestElementInMemory);
    if (loaded.bad() && object.trailing_bytes == 0)
        failed("cannot be read (" + std::string(loaded.text()) + ")");
    if (opened_->format.getDataset()->findAndGetElement(DCM_PixelData, element).good())
        opened_->pixels = dynamic_cast<DcmPixelData*>(element);
    if (!opened_->pixels)
        failed("it has no pixels");
}

FrameDecoder::~FrameDecoder() = default;

std::vector<std::uint16_t> FrameDecoder::storedPixels(int frame)
{
    const PixelFormat& format = object_.pixels;
    const std::vector<char> bytes = opened_->decoded(object_, frame);
    const std::size_t count = std::size_t(format.rows) * std::size_t(format.columns);
    std::vector<std::uint16_t> stored(count);
    if (format.bits_allocated == 16)
        std::memcpy(stored.data(), bytes.data(), count * 2);
    else
        std::transform(bytes.begin(), bytes.begin() + std::ptrdiff_t(count), stored.begin(),
                       [](char byte) { return std::uint8_t(byte); });
    return stored;
}

std::vector<std::int16_t> FrameDecoder::densities(const Slice& slice)
{
    Opened& opened = *opened_;
    const std::vector<std::uint16_t> stored = storedPixels(slice.frame);
    if (opened.table.empty() || opened.table_slope != slice.slope || opened.table_intercept != slice.intercept ||
        opened.table_shift != opened.shift) {
        opened.table = densityTable(object_.pixels, slice, opened.shift);
        opened.table_shift = opened.shift;
        opened.table_slope = slice.slope;
        opened.table_intercept = slice.intercept;
    }
    std::vector<std::int16_t> out(stored.size());
    std::transform(stored.begin(), stored.end(), out.begin(), [&](std::uint16_t v) { return opened.table[v]; });
    return out;
}

}  // namespace vicon::ingest
