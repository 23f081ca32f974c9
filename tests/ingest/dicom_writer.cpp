#include "dicom_writer.h"

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <stdexcept>

namespace fs = std::filesystem;

namespace vicon::test {
namespace {

std::string decimals(const std::vector<double>& values)
{
    std::ostringstream text;
    text.precision(10);
    for (std::size_t n = 0; n < values.size(); ++n)
        text << (n ? "\\" : "") << values[n];
    return text.str();
}

std::string decimals(Point3 p)
{
    return decimals(std::vector{p.x, p.y, p.z});
}

std::string directions(const SeriesSpec& spec)
{
    return decimals(std::vector{spec.row.x, spec.row.y, spec.row.z, spec.column.x, spec.column.y, spec.column.z});
}

void put(DcmItem& item, const DcmTagKey& tag, const std::string& value)
{
    if (item.putAndInsertString(tag, value.c_str()).bad())
        throw std::runtime_error("cannot write an element");
}

/// Stored values of a slice: the inverse of what import computes, with rubbish in the bits that are not stored.
std::vector<Uint16> storedPixels(const SeriesSpec& spec, int slice)
{
    std::vector<Uint16> pixels;
    const int range = 1 << spec.bits_stored, shift = std::max(0, spec.high_bit + 1 - spec.bits_stored);
    const int used = (range - 1) << shift;
    for (int j = 0; j < spec.rows; ++j)
        for (int i = 0; i < spec.columns; ++i) {
            const Point3 p = spec.position(slice) + spec.row * (spec.pixel_mm * i) + spec.column * (spec.row_mm * j);
            const double hu = spec.densities(p);
            const int value =
                std::isnan(hu) ? spec.padding.value() : int(std::lround((hu - spec.intercept) / spec.slope));
            const int rubbish = ((i * 7 + j * 13) & 0xffff) & ~used;
            pixels.push_back(Uint16(((value & (range - 1)) << shift) | rubbish));
        }
    return pixels;
}

void putCommon(DcmDataset& dataset, const SeriesSpec& spec)
{
    put(dataset, DCM_Modality, spec.modality);
    put(dataset, DCM_StudyInstanceUID, spec.study_uid);
    put(dataset, DCM_SeriesInstanceUID, spec.series_uid);
    put(dataset, DCM_FrameOfReferenceUID, spec.frame_of_reference_uid);
    put(dataset, DCM_PatientID, spec.patient_id);
    put(dataset, DCM_PatientName, spec.patient_name);
    put(dataset, DCM_PatientBirthDate, spec.birth_date);
    put(dataset, DCM_PatientPosition, spec.patient_position);
    put(dataset, DCM_ImageType, spec.image_type);
    put(dataset, DCM_StudyDate, "20260102");
    put(dataset, DCM_StudyTime, "101010");
    put(dataset, DCM_AcquisitionDate, "20260102");
    put(dataset, DCM_AcquisitionTime, spec.acquisition_time);
    put(dataset, DCM_SeriesNumber, std::to_string(spec.series_number));
    put(dataset, DCM_PhotometricInterpretation, "MONOCHROME2");
    dataset.putAndInsertUint16(DCM_SamplesPerPixel, 1);
    dataset.putAndInsertUint16(DCM_Rows, Uint16(spec.rows));
    dataset.putAndInsertUint16(DCM_Columns, Uint16(spec.columns));
    dataset.putAndInsertUint16(DCM_BitsAllocated, Uint16(spec.bits_allocated));
    dataset.putAndInsertUint16(DCM_BitsStored, Uint16(spec.bits_stored));
    dataset.putAndInsertUint16(DCM_HighBit, Uint16(spec.high_bit));
    dataset.putAndInsertUint16(DCM_PixelRepresentation, spec.is_signed ? 1 : 0);
    if (spec.padding && spec.is_signed)
        dataset.putAndInsertSint16(DCM_PixelPaddingValue, Sint16(*spec.padding));
    else if (spec.padding)
        dataset.putAndInsertUint16(DCM_PixelPaddingValue, Uint16(*spec.padding));
}

void putPixels(DcmDataset& dataset, const SeriesSpec& spec, const std::vector<Uint16>& pixels)
{
    if (spec.bits_allocated == 16) {
        dataset.putAndInsertUint16Array(DCM_PixelData, pixels.data(), pixels.size());
        return;
    }
    std::vector<Uint8> bytes(pixels.begin(), pixels.end());
    bytes.resize(bytes.size() + bytes.size() % 2);
    dataset.putAndInsertUint8Array(DCM_PixelData, bytes.data(), bytes.size());
}

void save(DcmFileFormat& format, const fs::path& file)
{
    fs::create_directories(file.parent_path());
    if (format.saveFile(file.c_str(), EXS_LittleEndianExplicit).bad())
        throw std::runtime_error("cannot write " + file.string());
}

DcmItem& newItem(DcmItem& holder, const DcmTagKey& sequence)
{
    DcmItem* item = nullptr;
    if (holder.findOrCreateSequenceItem(sequence, item, -2).bad())
        throw std::runtime_error("cannot write a sequence");
    return *item;
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
        DcmFileFormat format;
        DcmDataset& dataset = *format.getDataset();
        putCommon(dataset, spec);
        put(dataset, DCM_SOPClassUID, UID_CTImageStorage);
        put(dataset, DCM_SOPInstanceUID, spec.sopUid(slice));
        put(dataset, DCM_ImagePositionPatient, decimals(spec.position(slice)));
        put(dataset, DCM_ImageOrientationPatient, directions(spec));
        put(dataset, DCM_PixelSpacing, decimals(std::vector{spec.row_mm, spec.pixel_mm}));
        put(dataset, DCM_SliceThickness, decimals(std::vector{spec.thickness_mm}));
        put(dataset, DCM_RescaleSlope, decimals(std::vector{spec.slope}));
        put(dataset, DCM_RescaleIntercept, decimals(std::vector{spec.intercept}));
        put(dataset, DCM_ConvolutionKernel, spec.kernel);
        put(dataset, DCM_AcquisitionNumber, spec.acquisition_number);
        putPixels(dataset, spec, storedPixels(spec, slice));
        files.push_back(folder / (std::to_string(slice) + ".dcm"));
        save(format, files.back());
    }
    return files;
}

fs::path writeEnhanced(const fs::path& file, const SeriesSpec& spec, const std::vector<int>& order)
{
    DcmFileFormat format;
    DcmDataset& dataset = *format.getDataset();
    putCommon(dataset, spec);
    put(dataset, DCM_SOPClassUID, UID_EnhancedCTImageStorage);
    put(dataset, DCM_SOPInstanceUID, spec.series_uid + ".1");
    put(dataset, DCM_NumberOfFrames, std::to_string(order.size()));
    DcmItem& shared = newItem(dataset, DCM_SharedFunctionalGroupsSequence);
    put(newItem(shared, DCM_PlaneOrientationSequence), DCM_ImageOrientationPatient, directions(spec));
    DcmItem& measures = newItem(shared, DCM_PixelMeasuresSequence);
    put(measures, DCM_PixelSpacing, decimals(std::vector{spec.row_mm, spec.pixel_mm}));
    put(measures, DCM_SliceThickness, decimals(std::vector{spec.thickness_mm}));
    put(newItem(shared, DCM_CTReconstructionSequence), DCM_ConvolutionKernel, spec.kernel);
    newItem(shared, DCM_CTXRayDetailsSequence).putAndInsertFloat64(DCM_KVP, 110);
    std::vector<Uint16> pixels;
    for (const int slice : order) {
        DcmItem& frame = newItem(dataset, DCM_PerFrameFunctionalGroupsSequence);
        put(newItem(frame, DCM_PlanePositionSequence), DCM_ImagePositionPatient, decimals(spec.position(slice)));
        DcmItem& transformation = newItem(frame, DCM_PixelValueTransformationSequence);
        // Each frame with an intercept of its own, as the functional group allows.
        SeriesSpec own = spec;
        own.intercept = spec.intercept - slice;
        put(transformation, DCM_RescaleSlope, decimals(std::vector{own.slope}));
        put(transformation, DCM_RescaleIntercept, decimals(std::vector{own.intercept}));
        put(transformation, DCM_RescaleType, "HU");
        const auto frame_pixels = storedPixels(own, slice);
        pixels.insert(pixels.end(), frame_pixels.begin(), frame_pixels.end());
    }
    putPixels(dataset, spec, pixels);
    save(format, file);
    return file;
}

}  // namespace vicon::test
