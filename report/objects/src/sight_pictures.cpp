#include <algorithm>
#include <future>
#include <map>
#include <mutex>

#include "object_writing.h"
#include "vicon/core/error.h"
#include "vicon/dicom/dicom_setup.h"
#include "vicon/picture/png_file.h"

namespace vicon::report {
namespace {

/// From left to right, the tops in line, on black.
picture::Picture sideBySide(const std::vector<picture::SharedPicture>& parts)
{
    picture::Picture all;
    for (const auto& part : parts) {
        all.width += part->width;
        all.height = std::max(all.height, part->height);
    }
    const auto row = std::size_t(all.width) * std::size_t(all.channels);
    all.pixels.resize(row * std::size_t(all.height));
    std::size_t left = 0;
    for (const auto& part : parts) {
        const auto part_row = std::size_t(part->width) * std::size_t(part->channels);
        for (std::size_t y = 0; y < std::size_t(part->height); ++y)
            std::copy_n(&part->pixels[y * part_row], part_row, &all.pixels[y * row + left]);
        left += part_row;
    }
    return all;
}

void putPixels(DcmItem& d, const picture::Picture& picture)
{
    constexpr Uint16 kBits = 8;
    d.putAndInsertUint16(DCM_SamplesPerPixel, Uint16(picture.channels));
    put(d, DCM_PhotometricInterpretation, "RGB");
    d.putAndInsertUint16(DCM_PlanarConfiguration, 0);
    d.putAndInsertUint16(DCM_Rows, Uint16(picture.height));
    d.putAndInsertUint16(DCM_Columns, Uint16(picture.width));
    d.putAndInsertUint16(DCM_BitsAllocated, kBits);
    d.putAndInsertUint16(DCM_BitsStored, kBits);
    d.putAndInsertUint16(DCM_HighBit, kBits - 1);
    d.putAndInsertUint16(DCM_PixelRepresentation, 0);
    const OFCondition done = d.putAndInsertUint8Array(DCM_PixelData, picture.pixels.data(),
                                                      static_cast<unsigned long>(picture.pixels.size()));
    if (done.bad())
        throw Error(ErrorCode::no_memory, "the picture does not go into an object", done.text());
}

void pack(DcmDataset& d, const std::vector<picture::SharedPicture>& pictures)
{
    putPixels(d, sideBySide(pictures));
    if (const OFCondition packed = d.chooseRepresentation(EXS_RLELossless, nullptr); packed.bad())
        throw Error(ErrorCode::internal, "the picture cannot be compressed", packed.text());
    d.removeAllButCurrentRepresentations();
}

void putSource(DcmItem& d, const SourceImage& source)
{
    DcmItem* item = nullptr;
    if (d.findOrCreateSequenceItem(DCM_SourceImageSequence, item, 0).bad())
        throw Error(ErrorCode::no_memory, "the picture does not go into an object");
    put(*item, DCM_ReferencedSOPClassUID, source.sop_class);
    put(*item, DCM_ReferencedSOPInstanceUID, source.sop_uid);
}

}  // namespace

struct PackedSights::Packed {
    DcmFileFormat format;  ///< pixels alone
};

namespace {

std::unique_ptr<PackedSights::Packed> packedOf(const std::vector<picture::SharedPicture>& pictures)
{
    auto out = std::make_unique<PackedSights::Packed>();
    pack(*out->format.getDataset(), pictures);
    return out;
}

}  // namespace

struct PackedSights::Work {
    std::mutex mutex;
    std::map<std::string, std::future<std::unique_ptr<Packed>>> sights;
};

PackedSights::PackedSights() : work_(std::make_unique<Work>())
{
    setUpDicom();
}

PackedSights::~PackedSights() = default;

void PackedSights::begin(const std::string& marker_id, std::vector<picture::SharedPicture> pictures)
{
    const std::lock_guard lock(work_->mutex);
    work_->sights[marker_id] = std::async(std::launch::async, packedOf, std::move(pictures));
}

std::unique_ptr<PackedSights::Packed> PackedSights::take(const std::string& marker_id)
{
    std::future<std::unique_ptr<Packed>> begun;
    {
        const std::lock_guard lock(work_->mutex);
        begun = std::move(work_->sights.at(marker_id));
    }
    return begun.get();
}

/// PS3.3 A.8.1, RLE: lossless, and half the bytes at next to no cost. One object for all pictures of a sight: it is
/// read as one, and archives take longer over many objects than over large ones.
ReportObject writePictures(const ObjectContent& content, const SightPictures& pictures, int number,
                           const SourceImage* source, const std::filesystem::path& folder)
{
    const ObjectName name{ObjectKind::picture, "OT", "Pictures of the findings", pictures.marker_id, number};
    const auto packed = content.packed->take(pictures.marker_id);
    DcmFileFormat& format = packed->format;
    DcmDataset& d = *format.getDataset();
    put(d, DCM_SOPClassUID, UID_SecondaryCaptureImageStorage);
    putCommon(d, content, name);
    put(d, DCM_ConversionType, "WSD");
    put(d, DCM_ImageType, "DERIVED\\SECONDARY");
    put(d, DCM_DerivationDescription, "rendered by VICON");
    put(d, DCM_ImageComments, pictures.what);
    put(d, DCM_PatientOrientation, "");
    put(d, DCM_Laterality, "");
    put(d, DCM_BurnedInAnnotation, "NO");
    put(d, DCM_LossyImageCompression, "00");
    if (source)
        putSource(d, *source);
    return save(format, content, name, folder, EXS_RLELossless);
}

}  // namespace vicon::report
