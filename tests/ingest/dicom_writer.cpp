#include "dicom_writer.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "dicom_object.h"

namespace fs = std::filesystem;

namespace vicon::test {
namespace {

using phantom::DicomItem;
using phantom::DicomObject;

std::string decimals(Point3 p)
{
    return phantom::decimals({p.x, p.y, p.z});
}

std::string directions(const SeriesSpec& spec)
{
    return phantom::decimals({spec.row.x, spec.row.y, spec.row.z, spec.column.x, spec.column.y, spec.column.z});
}

/// Stored values of a slice: the inverse of what import computes, with rubbish in the bits that are not stored.
std::vector<std::uint16_t> storedPixels(const SeriesSpec& spec, int slice)
{
    std::vector<std::uint16_t> pixels;
    const int range = 1 << spec.bits_stored, shift = std::max(0, spec.high_bit + 1 - spec.bits_stored);
    const int used = (range - 1) << shift;
    for (int j = 0; j < spec.rows; ++j)
        for (int i = 0; i < spec.columns; ++i) {
            const Point3 p = spec.position(slice) + spec.row * (spec.pixel_mm * i) + spec.column * (spec.row_mm * j);
            const double hu = spec.densities(p);
            const int value =
                std::isnan(hu) ? spec.padding.value() : int(std::lround((hu - spec.intercept) / spec.slope));
            const int rubbish = ((i * 7 + j * 13) & 0xffff) & ~used;
            pixels.push_back(std::uint16_t(((value & (range - 1)) << shift) | rubbish));
        }
    return pixels;
}

void setCommon(DicomItem& d, const SeriesSpec& spec)
{
    d.set(DCM_Modality, spec.modality);
    d.set(DCM_StudyInstanceUID, spec.study_uid);
    d.set(DCM_SeriesInstanceUID, spec.series_uid);
    d.set(DCM_FrameOfReferenceUID, spec.frame_of_reference_uid);
    d.set(DCM_PatientID, spec.patient_id);
    d.set(DCM_PatientName, spec.patient_name);
    d.set(DCM_PatientBirthDate, spec.birth_date);
    d.set(DCM_PatientPosition, spec.patient_position);
    d.set(DCM_ImageType, spec.image_type);
    d.set(DCM_StudyDate, spec.study_date);
    if (!spec.accession_number.empty())
        d.set(DCM_AccessionNumber, spec.accession_number);
    if (!spec.referring_physician.empty())
        d.set(DCM_ReferringPhysicianName, spec.referring_physician);
    d.set(DCM_StudyTime, "101010");
    d.set(DCM_AcquisitionDate, "20260102");
    d.set(DCM_AcquisitionTime, spec.acquisition_time);
    d.set(DCM_SeriesNumber, std::to_string(spec.series_number));
    d.set(DCM_PhotometricInterpretation, "MONOCHROME2");
    d.setShort(DCM_SamplesPerPixel, 1);
    d.setShort(DCM_Rows, std::uint16_t(spec.rows));
    d.setShort(DCM_Columns, std::uint16_t(spec.columns));
    d.setShort(DCM_BitsAllocated, std::uint16_t(spec.bits_allocated));
    d.setShort(DCM_BitsStored, std::uint16_t(spec.bits_stored));
    d.setShort(DCM_HighBit, std::uint16_t(spec.high_bit));
    d.setShort(DCM_PixelRepresentation, spec.is_signed ? 1 : 0);
    if (spec.padding && spec.is_signed)
        d.setSigned(DCM_PixelPaddingValue, Sint16(*spec.padding));
    else if (spec.padding)
        d.setShort(DCM_PixelPaddingValue, Uint16(*spec.padding));
}

void setPixels(DicomItem& d, const SeriesSpec& spec, const std::vector<std::uint16_t>& pixels)
{
    if (spec.bits_allocated == 16) {
        d.setWords(DCM_PixelData, pixels);
        return;
    }
    std::vector<std::uint8_t> bytes(pixels.begin(), pixels.end());
    bytes.resize(bytes.size() + bytes.size() % 2);
    d.setBytes(DCM_PixelData, bytes);
}

void save(DicomObject& object, const fs::path& file)
{
    fs::create_directories(file.parent_path());
    object.save(file);
}

}  // namespace

std::vector<fs::path> writeSeries(const fs::path& folder, const SeriesSpec& spec, const std::vector<int>& slices)
{
    std::vector<int> wanted = slices;
    if (wanted.empty()) {
        wanted.resize(std::size_t(spec.slices));
        std::iota(wanted.begin(), wanted.end(), 0);
    }
    std::vector<fs::path> files;
    for (const int slice : wanted) {
        DicomObject d;
        setCommon(d, spec);
        d.set(DCM_SOPClassUID, spec.mr_images ? UID_MRImageStorage : UID_CTImageStorage);
        if (!spec.echo_time.empty())
            d.set(DCM_EchoTime, spec.echo_time);
        d.set(DCM_SOPInstanceUID, spec.sopUid(slice));
        d.set(DCM_ImagePositionPatient, decimals(spec.position(slice)));
        d.set(DCM_ImageOrientationPatient, directions(spec));
        d.set(DCM_PixelSpacing, phantom::decimals({spec.row_mm, spec.pixel_mm}));
        d.set(DCM_SliceThickness, phantom::decimals({spec.thickness_mm}));
        if (!spec.mr_images || spec.slope != 1 || spec.intercept != 0) {
            d.set(DCM_RescaleSlope, phantom::decimals({spec.slope}));
            d.set(DCM_RescaleIntercept, phantom::decimals({spec.intercept}));
        }
        d.set(DCM_ConvolutionKernel, spec.kernel);
        d.set(DCM_AcquisitionNumber, spec.acquisition_number);
        setPixels(d, spec, storedPixels(spec, slice));
        files.push_back(folder / (std::to_string(slice) + ".dcm"));
        save(d, files.back());
    }
    return files;
}

fs::path writeEnhanced(const fs::path& file, const SeriesSpec& spec, const std::vector<int>& order,
                       const std::vector<std::string>& kernels)
{
    DicomObject d;
    setCommon(d, spec);
    d.set(DCM_SOPClassUID, UID_EnhancedCTImageStorage);
    d.set(DCM_SOPInstanceUID, spec.series_uid + ".1" + spec.sop_suffix);
    d.set(DCM_NumberOfFrames, std::to_string(order.size()));
    DicomItem shared = d.append(DCM_SharedFunctionalGroupsSequence);
    shared.append(DCM_PlaneOrientationSequence).set(DCM_ImageOrientationPatient, directions(spec));
    DicomItem measures = shared.append(DCM_PixelMeasuresSequence);
    measures.set(DCM_PixelSpacing, phantom::decimals({spec.row_mm, spec.pixel_mm}));
    measures.set(DCM_SliceThickness, phantom::decimals({spec.thickness_mm}));
    if (kernels.empty())
        shared.append(DCM_CTReconstructionSequence).set(DCM_ConvolutionKernel, spec.kernel);
    shared.append(DCM_CTXRayDetailsSequence).setDouble(DCM_KVP, 110);
    std::vector<std::uint16_t> pixels;
    for (std::size_t n = 0; n < order.size(); ++n) {
        const int slice = order[n];
        DicomItem frame = d.append(DCM_PerFrameFunctionalGroupsSequence);
        if (!kernels.empty())
            frame.append(DCM_CTReconstructionSequence).set(DCM_ConvolutionKernel, kernels.at(n));
        frame.append(DCM_PlanePositionSequence).set(DCM_ImagePositionPatient, decimals(spec.position(slice)));
        DicomItem transformation = frame.append(DCM_PixelValueTransformationSequence);
        // Each frame with an intercept of its own, as the functional group allows.
        SeriesSpec own = spec;
        own.intercept = spec.intercept - slice;
        transformation.set(DCM_RescaleSlope, phantom::decimals({own.slope}));
        transformation.set(DCM_RescaleIntercept, phantom::decimals({own.intercept}));
        transformation.set(DCM_RescaleType, "HU");
        const auto frame_pixels = storedPixels(own, slice);
        pixels.insert(pixels.end(), frame_pixels.begin(), frame_pixels.end());
    }
    setPixels(d, spec, pixels);
    save(d, file);
    return file;
}

}  // namespace vicon::test
