#include "jpeg_codec.h"

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcpixel.h>
#include <dcmtk/dcmdata/dcpixseq.h>
#include <dcmtk/dcmdata/dcpxitem.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmjpeg/djdecode.h>

#include "vicon/core/error.h"

namespace vicon::ingest {
namespace {

[[noreturn]] void failed(const std::string& why)
{
    throw Error(ErrorCode::bad_input, why);
}

void describe(DcmDataset& dataset, const PixelFormat& format)
{
    dataset.putAndInsertUint16(DCM_SamplesPerPixel, 1);
    dataset.putAndInsertString(DCM_PhotometricInterpretation, "MONOCHROME2");
    dataset.putAndInsertUint16(DCM_Rows, Uint16(format.rows));
    dataset.putAndInsertUint16(DCM_Columns, Uint16(format.columns));
    dataset.putAndInsertUint16(DCM_BitsAllocated, Uint16(format.bits_allocated));
    dataset.putAndInsertUint16(DCM_BitsStored, Uint16(format.bits_stored));
    dataset.putAndInsertUint16(DCM_HighBit, Uint16(format.high_bit));
    dataset.putAndInsertUint16(DCM_PixelRepresentation, format.is_signed ? 1 : 0);
}

/// Puts the stream into `dataset` as its only fragment. The data set owns what is returned.
DcmPixelData& insertStream(DcmDataset& dataset, const std::string& stream, E_TransferSyntax syntax)
{
    auto sequence = std::make_unique<DcmPixelSequence>(DCM_PixelSequenceTag);
    auto fragment = std::make_unique<DcmPixelItem>(DCM_PixelItemTag);
    sequence->insert(new DcmPixelItem(DCM_PixelItemTag));  // the offset table, empty
    const bool odd = stream.size() % 2 != 0;
    const std::string even = odd ? stream + '\0' : stream;
    if (fragment->putUint8Array(reinterpret_cast<const Uint8*>(even.data()), even.size()).bad())
        failed("its compressed pixels cannot be read");
    sequence->insert(fragment.release());
    auto pixels = std::make_unique<DcmPixelData>(DCM_PixelData);
    pixels->putOriginalRepresentation(syntax, nullptr, sequence.release());
    DcmPixelData& inserted = *pixels;
    if (dataset.insert(pixels.release(), true).bad())
        failed("its compressed pixels cannot be read");
    return inserted;
}

}  // namespace

void setUpJpeg()
{
    DJDecoderRegistration::registerCodecs();
}

std::vector<char> decodeWithDcmtk(const std::string& stream, const PixelFormat& format,
                                  const std::string& transfer_syntax)
{
    DcmDataset dataset;
    describe(dataset, format);
    DcmPixelData& pixels = insertStream(dataset, stream, DcmXfer(transfer_syntax.c_str()).getXfer());
    const std::size_t needed =
        std::size_t(format.rows) * std::size_t(format.columns) * std::size_t(format.bits_allocated / 8);
    std::vector<char> bytes(needed + needed % 2);
    Uint32 start_fragment = 0;
    OFString color_model;
    const OFCondition done = pixels.getUncompressedFrame(&dataset, 0, start_fragment, bytes.data(),
                                                         Uint32(bytes.size()), color_model, nullptr);
    if (done.bad())
        failed("its pixels cannot be decoded (" + std::string(done.text()) + ")");
    bytes.resize(needed);
    return bytes;
}

}  // namespace vicon::ingest
