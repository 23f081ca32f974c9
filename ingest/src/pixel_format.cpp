#include "pixel_format.h"

#include <dcmtk/dcmdata/dcpixel.h>

#include <array>

#include "compressed_frames.h"
#include "encoding.h"
#include "stream_guard.h"
#include "vicon/core/error.h"

namespace vicon::ingest {
namespace {

/// What the pixel element holds, without decoding it: empty when it can be complete.
std::string checkNative(DcmElement& pixels, const PixelFormat& format)
{
    const std::uint64_t needed = std::uint64_t(format.rows) * std::uint64_t(format.columns) *
                                 std::uint64_t(format.frames) * std::uint64_t(format.bits_allocated / 8);
    if (pixels.getLengthField() < needed)
        return "its pixels are cut off (" + std::to_string(pixels.getLengthField()) + " of " + std::to_string(needed) +
               " bytes)";
    if (pixels.getLengthField() > needed + needed % 2)
        return "it has more pixels than its header says (" + std::to_string(pixels.getLengthField()) + " bytes, " +
               std::to_string(needed) + " are described)";
    return {};
}

/// Whether a compressed frame ends as JPEG, JPEG-LS or JPEG 2000 streams do.
bool hasEndMark(const std::string& stream)
{
    std::size_t length = stream.size();
    while (length > 2 && stream[length - 1] == 0)  // padding to an even length; some writers pad more
        --length;
    return length >= 2 && stream[length - 2] == '\xff' && stream[length - 1] == '\xd9';
}

std::string checkEncapsulated(DcmPixelData& pixels, ImageObject& object)
{
    const std::string& syntax = object.transfer_syntax;
    if (!isDecodable(syntax))
        return "its encoding is not supported (" + std::string(DcmXfer(syntax.c_str()).getXferName()) + ")";
    try {
        const CompressedFrames frames(pixels, syntax, object.pixels.frames);
        for (int frame = 0; frame < object.pixels.frames && !isRle(syntax); ++frame) {
            const std::string stream = frames.stream(frame);
            if (std::string why = whyNotDecodable(stream, object.pixels, syntax); !why.empty())
                return why;
            object.doubtful = object.doubtful || !hasEndMark(stream);
        }
        object.doubtful = object.doubtful || isRle(syntax);  // has no marks: its runs have to be counted
    } catch (const Error& e) {
        return e.what();
    }
    return {};
}

std::string checkPixels(const Dataset& dataset, ImageObject& object)
{
    DcmElement* element = nullptr;
    if (dataset.dcmItem().findAndGetElement(DCM_PixelData, element).bad() || !element)
        return "it has no pixels";
    const DcmXfer xfer(object.transfer_syntax.c_str());
    if (!xfer.isEncapsulated())
        return checkNative(*element, object.pixels);
    auto* pixels = dynamic_cast<DcmPixelData*>(element);
    return pixels ? checkEncapsulated(*pixels, object) : "its compressed pixels cannot be read";
}

/// Whether a padding value, given in two bytes, signed or not, whatever the pixels are, can be a stored value.
bool fitsStoredBits(int value, const PixelFormat& format)
{
    const int bits = value & 0xffff;
    const int range = 1 << format.bits_stored;
    if (!format.is_signed)
        return bits < range;
    const int number = bits >= 0x8000 ? bits - 0x10000 : bits;
    return bits < range || (number < 0 && number >= -range / 2);
}

/// A padding value as a stored value.
int asStoredValue(int value, const PixelFormat& format)
{
    const int bits = value & ((1 << format.bits_stored) - 1);
    const bool negative = format.is_signed && (bits >> (format.bits_stored - 1));
    return negative ? bits - (1 << format.bits_stored) : bits;
}

void readPadding(const Dataset& dataset, ImageObject& object)
{
    PixelFormat& format = object.pixels;
    const auto value = dataset.integer(DCM_PixelPaddingValue);
    if (!value)
        return;
    const int limit = dataset.integer(DCM_PixelPaddingRangeLimit).value_or(*value);
    if (!fitsStoredBits(*value, format) || !fitsStoredBits(limit, format)) {
        format.padding_cell = std::uint16_t(*value & 0xffff);
        object.repairs.emplace_back(
            "the padding value does not fit the stored bits: only pixels that hold it as a whole "
            "are padding");
        return;
    }
    const int first = asStoredValue(*value, format);
    const int last = asStoredValue(limit, format);
    format.padding = std::minmax(first, last);
}

}  // namespace

bool isLossy(const Dataset& dataset, const std::string& transfer_syntax)
{
    static constexpr std::array kLossySyntaxes{UID_JPEGProcess1TransferSyntax,     UID_JPEGProcess2_4TransferSyntax,
                                               UID_JPEGProcess3_5TransferSyntax,   UID_JPEGProcess6_8TransferSyntax,
                                               UID_JPEGProcess7_9TransferSyntax,   UID_JPEGProcess10_12TransferSyntax,
                                               UID_JPEGProcess11_13TransferSyntax, UID_JPEGLSLossyTransferSyntax};
    const auto said = dataset.values(DCM_LossyImageCompression);
    if (!said.empty() && said.front() == "01")
        return true;
    for (const char* syntax : kLossySyntaxes)
        if (transfer_syntax == syntax)
            return true;
    // This syntax carries both kinds; without the word of the writer it has to be taken for lossy.
    return transfer_syntax == UID_JPEG2000TransferSyntax && (said.empty() || said.front() != "00");
}

std::string readPixelFormat(const Dataset& dataset, const ImportOptions& options, ImageObject& object)
{
    PixelFormat& format = object.pixels;
    format.rows = dataset.integer(DCM_Rows).value_or(0);
    format.columns = dataset.integer(DCM_Columns).value_or(0);
    format.bits_allocated = dataset.integer(DCM_BitsAllocated).value_or(0);
    format.bits_stored = dataset.integer(DCM_BitsStored).value_or(0);
    format.high_bit = dataset.integer(DCM_HighBit).value_or(format.bits_stored - 1);
    format.is_signed = dataset.integer(DCM_PixelRepresentation).value_or(0) == 1;
    format.frames = dataset.integer(DCM_NumberOfFrames).value_or(1);
    if (!dataset.has(DCM_PixelData))
        return "it has no pixels";
    if (dataset.integer(DCM_SamplesPerPixel).value_or(1) != 1)
        return "its pixels are colours, not densities";
    const auto meaning = dataset.values(DCM_PhotometricInterpretation);
    if (!meaning.empty() && !meaning.front().empty() && !meaning.front().starts_with("MONOCHROME"))
        return "its pixels are colours, not densities (" + meaning.front() + ")";
    if (format.frames < 1)
        return "it claims to have " + std::to_string(format.frames) + " frames";
    if (format.rows < 2 || format.columns < 2)
        return "it claims to have " + std::to_string(format.columns) + " x " + std::to_string(format.rows) + " pixels";
    if (format.rows > options.largest_matrix || format.columns > options.largest_matrix)
        return "it claims to have " + std::to_string(format.columns) + " x " + std::to_string(format.rows) +
               " pixels, more than import.largest_matrix allows";
    if ((format.bits_allocated != 8 && format.bits_allocated != 16) || format.bits_stored < 1 ||
        format.bits_stored > format.bits_allocated || format.high_bit >= format.bits_allocated ||
        format.high_bit + 1 < format.bits_stored)
        return "its pixel format cannot be used (" + std::to_string(format.bits_stored) + " of " +
               std::to_string(format.bits_allocated) + " bits)";
    readPadding(dataset, object);
    return checkPixels(dataset, object);
}

}  // namespace vicon::ingest
