#include "pixels.h"

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcfcache.h>
#include <dcmtk/dcmdata/dcpixel.h>
#include <dcmtk/dcmdata/dcpixseq.h>
#include <dcmtk/dcmdata/dcpxitem.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "dataset.h"
#include "dicom_setup.h"
#include "gdcm_codec.h"
#include "pixel_format.h"
#include "vicon/core/error.h"
#include "vicon/core/volume.h"

namespace vicon::ingest {
namespace {

constexpr Uint32 kLargestElementInMemory = 16384;

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

/// A density for each 16-bit pattern of a stored pixel.
std::vector<std::int16_t> densityTable(const PixelFormat& format, const Slice& slice)
{
    constexpr std::size_t kPatterns = 65536;
    std::vector<std::int16_t> table(kPatterns);
    const int shift = format.high_bit + 1 - format.bits_stored;
    const int range = 1 << format.bits_stored;
    for (std::size_t pattern = 0; pattern < kPatterns; ++pattern) {
        int stored = (int(pattern) >> shift) & (range - 1);
        if (format.is_signed && stored >= range / 2)
            stored -= range;
        const bool padding = format.padding && stored >= format.padding->first && stored <= format.padding->second;
        const double hu = slice.slope * stored + slice.intercept;
        table[pattern] = padding || hu < kLightest_hu ? kPaddingHu : measured(hu);
    }
    return table;
}

/// Where the fragments of a frame begin and end in a pixel sequence (fragment 0 is the offset table).
std::pair<unsigned long, unsigned long> fragmentsOfFrame(DcmPixelSequence& sequence, int frame, int frames)
{
    const unsigned long count = sequence.card() - 1;
    if (frames == 1)
        return {1, count + 1};
    if (count == unsigned(frames))
        return {1 + unsigned(frame), 2 + unsigned(frame)};
    return {0, 0};
}

}  // namespace

struct FrameDecoder::Opened {
    DcmFileFormat format;
    DcmFileCache cache;
    DcmPixelData* pixels = nullptr;
    std::vector<std::int16_t> table;
    double table_slope = 0, table_intercept = 0;

    std::string compressedStream(const ImageObject& object, int frame)
    {
        DcmPixelSequence* sequence = nullptr;
        const DcmXfer xfer(object.transfer_syntax.c_str());
        if (pixels->getEncapsulatedRepresentation(xfer.getXfer(), nullptr, sequence).bad() || !sequence)
            failed("its compressed pixels cannot be read");
        const auto [first, last] = fragmentsOfFrame(*sequence, frame, object.pixels.frames);
        if (first == last)
            failed("its frames are split into parts, which is not supported for this encoding");
        std::string stream;
        for (unsigned long n = first; n < last; ++n) {
            DcmPixelItem* item = nullptr;
            Uint8* bytes = nullptr;
            if (sequence->getItem(item, n).bad() || item->getUint8Array(bytes).bad() || !bytes)
                failed("its compressed pixels cannot be read");
            stream.append(reinterpret_cast<const char*>(bytes), item->getLength());
            item->compact();
        }
        return stream;
    }

    std::vector<char> decoded(const ImageObject& object, int frame)
    {
        const PixelFormat& f = object.pixels;
        if (isDecodedByGdcm(object.transfer_syntax))
            return decodeWithGdcm(compressedStream(object, frame), f, object.transfer_syntax);
        const std::size_t needed = std::size_t(f.rows) * std::size_t(f.columns) * std::size_t(f.bits_allocated / 8);
        std::vector<char> bytes(needed + needed % 2);
        Uint32 start_fragment = 0;
        OFString color_model;
        const OFCondition done = pixels->getUncompressedFrame(format.getDataset(), Uint32(frame), start_fragment,
                                                              bytes.data(), Uint32(bytes.size()), color_model, &cache);
        if (done.bad())
            failed("its pixels cannot be decoded (" + std::string(done.text()) + ")");
        return bytes;
    }
};

FrameDecoder::FrameDecoder(const ImageObject& object) : object_(object), opened_(std::make_unique<Opened>())
{
    setUpDicom();
    DcmElement* element = nullptr;
    const OFCondition loaded =
        opened_->format.loadFile(object.file.c_str(), EXS_Unknown, EGL_noChange, kLargestElementInMemory);
    if (loaded.bad())
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
    if (opened.table.empty() || opened.table_slope != slice.slope || opened.table_intercept != slice.intercept) {
        opened.table = densityTable(object_.pixels, slice);
        opened.table_slope = slice.slope;
        opened.table_intercept = slice.intercept;
    }
    const std::vector<std::uint16_t> stored = storedPixels(slice.frame);
    std::vector<std::int16_t> out(stored.size());
    std::transform(stored.begin(), stored.end(), out.begin(), [&](std::uint16_t v) { return opened.table[v]; });
    return out;
}

}  // namespace vicon::ingest
