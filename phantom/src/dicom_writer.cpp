#include "dicom_writer.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "dicom_object.h"
#include "uid.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon::phantom {
namespace {

constexpr std::int16_t kIntercept = -1024;
constexpr std::int16_t kPaddingStored = -2000;

void setStudy(DicomObject& d, const StudyHeader& study, const SeriesHeader& series)
{
    d.set(DCM_SpecificCharacterSet, "ISO_IR 100");
    d.set(DCM_StudyDate, study.date);
    d.set(DCM_SeriesDate, study.date);
    d.set(DCM_ContentDate, study.date);
    d.set(DCM_StudyTime, "090000");
    d.set(DCM_SeriesTime, "090500");
    d.set(DCM_ContentTime, "090500");
    d.set(DCM_AccessionNumber, study.accession_number);
    d.set(DCM_Manufacturer, "VICON");
    d.set(DCM_ManufacturerModelName, "Phantom");
    d.set(DCM_SoftwareVersions, "1");
    d.set(DCM_ReferringPhysicianName, "");
    d.set(DCM_StudyDescription, study.description);
    d.set(DCM_SeriesDescription, series.description);
    d.set(DCM_PatientName, study.patient_name);
    d.set(DCM_PatientID, study.patient_id);
    d.set(DCM_PatientBirthDate, study.birth_date);
    d.set(DCM_PatientSex, study.sex);
    d.set(DCM_BodyPartExamined, study.body_part);
    d.set(DCM_StudyInstanceUID, study.study_uid);
    d.set(DCM_SeriesInstanceUID, series.uid);
    d.set(DCM_StudyID, study.study_id);
    d.set(DCM_SeriesNumber, std::to_string(series.number));
}

void setInstance(DicomObject& d, const char* sop_class, const StudyHeader& study, const SeriesHeader& series,
                 int number)
{
    d.set(DCM_SOPClassUID, sop_class);
    d.set(DCM_SOPInstanceUID, uidFor(study.key, series.uid, std::uint64_t(number)));
    d.set(DCM_InstanceNumber, std::to_string(number));
}

void setAcquisition(DicomObject& d, const StudyHeader& study, const SeriesHeader& series)
{
    d.set(DCM_Modality, series.modality);
    d.set(DCM_PatientPosition, series.patient_position);
    d.set(DCM_FrameOfReferenceUID, uidFor(study.key, "frame " + series.patient_position));
    d.set(DCM_PositionReferenceIndicator, "");
    d.set(DCM_AcquisitionNumber, "1");
    d.set(DCM_AcquisitionDate, study.date);
    d.set(DCM_AcquisitionTime, "090500");
    d.set(DCM_ProtocolName, study.protocol);
}

void setCt(DicomObject& d, const StudyHeader& study, const SeriesHeader& series)
{
    setAcquisition(d, study, series);
    d.set(DCM_KVP, "120");
    d.set(DCM_XRayTubeCurrent, "60");
    d.set(DCM_GantryDetectorTilt, "0");
    d.set(DCM_RescaleIntercept, std::to_string(kIntercept));
    d.set(DCM_RescaleSlope, "1");
}

/// As a spoiled gradient echo of the whole abdomen.
void setMr(DicomObject& d, const StudyHeader& study, const SeriesHeader& series)
{
    setAcquisition(d, study, series);
    d.set(DCM_ScanningSequence, "GR");
    d.set(DCM_SequenceVariant, "SP");
    d.set(DCM_ScanOptions, "FS");
    d.set(DCM_MRAcquisitionType, "3D");
    d.set(DCM_RepetitionTime, "3.2");
    d.set(DCM_EchoTime, "1.2");
    d.set(DCM_EchoTrainLength, "1");
    d.set(DCM_FlipAngle, "10");
    d.set(DCM_MagneticFieldStrength, "1.5");
}

void setPicture(DicomObject& d, int rows, int columns, int bits, bool is_signed)
{
    d.setShort(DCM_SamplesPerPixel, 1);
    d.set(DCM_PhotometricInterpretation, "MONOCHROME2");
    d.setShort(DCM_Rows, std::uint16_t(rows));
    d.setShort(DCM_Columns, std::uint16_t(columns));
    d.setShort(DCM_BitsAllocated, std::uint16_t(bits));
    d.setShort(DCM_BitsStored, std::uint16_t(bits));
    d.setShort(DCM_HighBit, std::uint16_t(bits - 1));
    d.setShort(DCM_PixelRepresentation, is_signed ? 1 : 0);
}

void setPlane(DicomObject& d, Point3 origin, Vector3 row, Vector3 column, double row_spacing_mm,
              double column_spacing_mm)
{
    d.set(DCM_ImagePositionPatient, decimals({origin.x, origin.y, origin.z}));
    d.set(DCM_ImageOrientationPatient, decimals({row.x, row.y, row.z, column.x, column.y, column.z}));
    d.set(DCM_PixelSpacing, decimals({row_spacing_mm, column_spacing_mm}));
}

/// Values as the scanner stores them: densities offset by the intercept, padding as a value that no tissue has; a
/// signal as it is.
std::vector<std::uint16_t> stored(const std::int16_t* hu, std::size_t count, bool signal)
{
    std::vector<std::uint16_t> values(count);
    if (signal)
        std::copy_n(hu, count, values.begin());
    else
        std::transform(hu, hu + count, values.begin(),
                       [](std::int16_t v) { return std::uint16_t(v == kPaddingHu ? kPaddingStored : v - kIntercept); });
    return values;
}

void setKindOfImage(DicomObject& d, const StudyHeader& study, const SeriesHeader& series, const Grid& grid)
{
    if (series.modality == "MR") {
        setMr(d, study, series);
        d.set(DCM_ImageType, "ORIGINAL\\PRIMARY\\M\\NONE");
        return;
    }
    setCt(d, study, series);
    d.set(DCM_ImageType, "ORIGINAL\\PRIMARY\\AXIAL");
    d.set(DCM_RescaleType, "HU");
    d.set(DCM_ConvolutionKernel, "SOFT");
    d.set(DCM_DataCollectionDiameter, "500");
    d.set(DCM_ReconstructionDiameter, decimal(grid.spacing_mm[0] * grid.size[0]));
}

fs::path fileFor(const fs::path& folder, const StudyHeader& study, const SeriesHeader& series, int number)
{
    return folder / (shuffledName(study.key, series.uid, std::uint64_t(number)) + ".dcm");
}

void writeSlice(const fs::path& folder, const StudyHeader& study, const SeriesHeader& series, const HuVolume& hu, int k)
{
    const Grid& grid = hu.grid;
    // Scanners count along the table's way; instances are numbered from the head.
    const int number = grid.axis[2].z > 0 ? grid.size[2] - k : k + 1;
    DicomObject d;
    setStudy(d, study, series);
    const bool signal = series.modality == "MR";
    setInstance(d, signal ? UID_MRImageStorage : UID_CTImageStorage, study, series, number);
    setKindOfImage(d, study, series, grid);
    d.set(DCM_SliceThickness, decimal(grid.spacing_mm[2]));
    const Point3 origin = grid.pointAt(Index3{0, 0, k});
    setPlane(d, origin, grid.axis[0], grid.axis[1], grid.spacing_mm[1], grid.spacing_mm[0]);
    d.set(DCM_SliceLocation, decimal(dot(origin - Point3{}, grid.axis[2])));
    setPicture(d, grid.size[1], grid.size[0], 16, !signal);
    if (!signal)
        d.setSigned(DCM_PixelPaddingValue, kPaddingStored);
    d.set(DCM_WindowCenter, signal ? "450" : "0");
    d.set(DCM_WindowWidth, signal ? "900" : "1500");
    const std::size_t plane = std::size_t(grid.size[0]) * std::size_t(grid.size[1]);
    d.setWords(DCM_PixelData, stored(&hu.voxels[grid.offset({0, 0, k})], plane, signal));
    d.save(fileFor(folder, study, series, number));
}

}  // namespace

void writeSeries(const fs::path& folder, const StudyHeader& study, const SeriesHeader& series, const HuVolume& hu,
                 Progress& progress)
{
    makePrivateFolder(folder);
    writeSlice(folder, study, series, hu, 0);  // loads the dictionary before the threads share it
    tbb::parallel_for(1, hu.grid.size[2], [&](int k) {
        progress.check();
        writeSlice(folder, study, series, hu, k);
    });
}

void writeLocalizer(const fs::path& folder, const StudyHeader& study, const SeriesHeader& series, const HuVolume& hu)
{
    makePrivateFolder(folder);
    const Grid& grid = hu.grid;
    const auto [nx, ny, nz] = grid.size;
    const bool head_last = grid.axis[2].z > 0;  // the head is at the picture's top
    std::vector<std::uint16_t> picture(std::size_t(nx) * std::size_t(nz));
    for (int row = 0; row < nz; ++row)
        for (int i = 0; i < nx; ++i) {
            long sum = 0;
            for (int j = 0; j < ny; ++j)
                sum += hu.at({i, j, head_last ? nz - 1 - row : row});
            picture[std::size_t(row) * std::size_t(nx) + std::size_t(i)] =
                std::uint16_t(std::int16_t(sum / ny - kIntercept));
        }
    DicomObject d;
    setStudy(d, study, series);
    setInstance(d, UID_CTImageStorage, study, series, 1);
    setCt(d, study, series);
    d.set(DCM_ImageType, "ORIGINAL\\PRIMARY\\LOCALIZER");
    d.set(DCM_SliceThickness, decimal(grid.spacing_mm[1] * ny));
    setPlane(d, grid.pointAt(Index3{0, ny / 2, head_last ? nz - 1 : 0}), grid.axis[0],
             head_last ? -grid.axis[2] : grid.axis[2], grid.spacing_mm[2], grid.spacing_mm[0]);
    setPicture(d, nz, nx, 16, true);
    d.setWords(DCM_PixelData, picture);
    d.save(fileFor(folder, study, series, 1));
}

void writeDoseSheet(const fs::path& folder, const StudyHeader& study, const SeriesHeader& series)
{
    makePrivateFolder(folder);
    constexpr int kSize = 512;
    std::vector<Uint8> page(std::size_t(kSize) * kSize, 0);
    for (int y = 40; y < kSize - 40; ++y)
        for (int x = 40; x < kSize - 40; ++x)  // a ruled table
            if (y % 36 < 2 || (x - 40) % 108 < 2)
                page[std::size_t(y) * kSize + std::size_t(x)] = 200;
    DicomObject d;
    setStudy(d, study, series);
    setInstance(d, UID_SecondaryCaptureImageStorage, study, series, 1);
    d.set(DCM_Modality, "CT");
    d.set(DCM_ConversionType, "WSD");
    d.set(DCM_ImageType, "DERIVED\\SECONDARY");
    d.set(DCM_PatientOrientation, "");
    setPicture(d, kSize, kSize, 8, false);
    d.setBytes(DCM_PixelData, page);
    d.save(fileFor(folder, study, series, 1));
}

}  // namespace vicon::phantom
