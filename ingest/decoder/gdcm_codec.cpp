#include "gdcm_codec.h"

#include <gdcmByteValue.h>
#include <gdcmDataElement.h>
#include <gdcmFragment.h>
#include <gdcmJPEG2000Codec.h>
#include <gdcmJPEGLSCodec.h>
#include <gdcmPhotometricInterpretation.h>
#include <gdcmSequenceOfFragments.h>
#include <gdcmTransferSyntax.h>

#include "vicon/core/error.h"

namespace vicon::ingest {
namespace {

[[noreturn]] void failed(const char* why)
{
    throw Error(ErrorCode::bad_input, why);
}

}  // namespace

std::vector<char> decodeWithGdcm(const std::string& stream, const PixelFormat& format,
                                 const std::string& transfer_syntax)
{
    gdcm::Fragment fragment;
    fragment.SetByteValue(stream.data(), gdcm::VL(std::uint32_t(stream.size())));
    const gdcm::SmartPointer<gdcm::SequenceOfFragments> fragments = new gdcm::SequenceOfFragments;
    fragments->AddFragment(fragment);
    gdcm::DataElement encoded(gdcm::Tag(0x7fe0, 0x0010)), decoded;
    encoded.SetValue(*fragments);

    gdcm::JPEG2000Codec jpeg2000;
    gdcm::JPEGLSCodec jpeg_ls;
    const gdcm::TransferSyntax syntax(gdcm::TransferSyntax::GetTSType(transfer_syntax.c_str()));
    gdcm::ImageCodec& codec =
        jpeg2000.CanDecode(syntax) ? static_cast<gdcm::ImageCodec&>(jpeg2000) : static_cast<gdcm::ImageCodec&>(jpeg_ls);
    gdcm::PixelFormat pixels(1, std::uint16_t(format.bits_allocated), std::uint16_t(format.bits_stored),
                             std::uint16_t(format.high_bit), format.is_signed ? 1 : 0);
    const unsigned dimensions[2] = {unsigned(format.columns), unsigned(format.rows)};
    codec.SetNumberOfDimensions(2);
    codec.SetDimensions(dimensions);
    codec.SetPixelFormat(pixels);
    codec.SetPlanarConfiguration(0);
    codec.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
    if (!codec.CanDecode(syntax) || !codec.Decode(encoded, decoded))
        failed("its compressed pixels cannot be decoded");
    const gdcm::ByteValue* bytes = decoded.GetByteValue();
    const std::size_t needed =
        std::size_t(format.columns) * std::size_t(format.rows) * std::size_t(format.bits_allocated / 8);
    if (!bytes || std::size_t(bytes->GetLength()) < needed)
        failed("its compressed pixels make a smaller image than its header says");
    return {bytes->GetPointer(), bytes->GetPointer() + needed};
}

}  // namespace vicon::ingest
