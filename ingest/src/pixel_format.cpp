#include "pixel_format.h"

#include <dcmtk/dcmdata/dccodec.h>
#include <dcmtk/dcmdata/dcpixel.h>
#include <dcmtk/dcmdata/dcpixseq.h>
#include <dcmtk/dcmdata/dcpxitem.h>

#include <array>

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
    return {};
}

/// Whether a compressed frame begins and ends as JPEG, JPEG-LS or JPEG 2000 streams do; other encodings have no mark.
bool hasMarks(DcmPixelItem& first, DcmPixelItem& last, const std::string& syntax)
{
    if (syntax == UID_RLELosslessTransferSyntax)
        return true;
    Uint8* begin = nullptr;
    Uint8* end = nullptr;
    constexpr Uint32 kLeast = 4;
    if (first.getLength() < kLeast || last.getLength() < kLeast || first.getUint8Array(begin).bad() ||
        last.getUint8Array(end).bad() || !begin || !end)
        return false;
    Uint32 length = last.getLength();
    while (length > 2 && end[length - 1] == 0)  // padding to an even length; some writers pad more
        --length;
    const bool begins = begin[0] == 0xff && begin[1] == (isJpeg2000(syntax) ? 0x4f : 0xd8);
    const bool ends = end[length - 2] == 0xff && end[length - 1] == 0xd9;
    first.compact();
    last.compact();
    return begins && ends;
}

std::string checkEncapsulated(DcmPixelData& pixels, const PixelFormat& format, const std::string& syntax,
                              bool& doubtful)
{
    const DcmXfer xfer(syntax.c_str());
    const bool known =
        isDecodedByGdcm(syntax) || DcmCodecList::canChangeCoding(xfer.getXfer(), EXS_LittleEndianExplicit);
    if (!known)
        return "its encoding is not supported (" + std::string(xfer.getXferName()) + ")";
    DcmPixelSequence* sequence = nullptr;
    if (pixels.getEncapsulatedRepresentation(xfer.getXfer(), nullptr, sequence).bad() || !sequence)
        return "its compressed pixels cannot be read";
    if (sequence->card() < unsigned(format.frames) + 1)
        return "its compressed pixels are cut off";
    for (unsigned long n = 1; n < sequence->card(); ++n) {
        DcmPixelItem* fragment = nullptr;
        if (sequence->getItem(fragment, n).bad() || fragment->getLength() == 0)
            return "a part of its compressed pixels is empty";
    }
    const bool fragment_is_frame = sequence->card() == unsigned(format.frames) + 1;
    for (unsigned long n = 1; n < sequence->card() && !doubtful; n += fragment_is_frame ? 1 : sequence->card()) {
        DcmPixelItem *first = nullptr, *last = nullptr;
        sequence->getItem(first, n);
        sequence->getItem(last, fragment_is_frame ? n : sequence->card() - 1);
        doubtful = !hasMarks(*first, *last, syntax);
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
    return pixels ? checkEncapsulated(*pixels, object.pixels, object.transfer_syntax, object.doubtful)
                  : "its compressed pixels cannot be read";
}

/// A padding value as a stored value. Writers give it in two bytes, signed or not, whatever the pixels are.
int asStoredValue(int value, const PixelFormat& format)
{
    const int bits = value & ((1 << format.bits_stored) - 1);
    const bool negative = format.is_signed && (bits >> (format.bits_stored - 1));
    return negative ? bits - (1 << format.bits_stored) : bits;
}

void readPadding(const Dataset& dataset, PixelFormat& format)
{
    const auto value = dataset.integer(DCM_PixelPaddingValue);
    if (!value)
        return;
    const int first = asStoredValue(*value, format);
    const int last = asStoredValue(dataset.integer(DCM_PixelPaddingRangeLimit).value_or(*value), format);
    format.padding = std::minmax(first, last);
}

}  // namespace

bool isJpeg2000(const std::string& transfer_syntax)
{
    return transfer_syntax == UID_JPEG2000LosslessOnlyTransferSyntax || transfer_syntax == UID_JPEG2000TransferSyntax;
}

bool isDecodedByGdcm(const std::string& transfer_syntax)
{
    return isJpeg2000(transfer_syntax) || transfer_syntax == UID_JPEGLSLosslessTransferSyntax ||
           transfer_syntax == UID_JPEGLSLossyTransferSyntax;
}

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
    if (format.rows < 2 || format.columns < 2 || format.frames < 1)
        return "it claims to have " + std::to_string(format.columns) + " x " + std::to_string(format.rows) + " pixels";
    if (format.rows > options.largest_matrix || format.columns > options.largest_matrix)
        return "it claims to have " + std::to_string(format.columns) + " x " + std::to_string(format.rows) +
               " pixels, more than import.largest_matrix allows";
    if ((format.bits_allocated != 8 && format.bits_allocated != 16) || format.bits_stored < 1 ||
        format.bits_stored > format.bits_allocated || format.high_bit >= format.bits_allocated ||
        format.high_bit + 1 < format.bits_stored)
        return "its pixel format cannot be used (" + std::to_string(format.bits_stored) + " of " +
               std::to_string(format.bits_allocated) + " bits)";
    readPadding(dataset, format);
    return checkPixels(dataset, object);
}

}  // namespace vicon::ingest
