#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include <string>
#include <vector>

namespace vicon::fuzz {

/// A slice of a small axial series that import takes as it is, 8 x 8 pixels, 2 mm apart.
inline DcmDataset templateSlice(int n)
{
    const std::string series = "1.2.826.0.1.3680043.10.9.1";
    DcmDataset d;
    d.putAndInsertString(DCM_SOPClassUID, UID_CTImageStorage);
    d.putAndInsertString(DCM_SOPInstanceUID, (series + "." + std::to_string(n + 1)).c_str());
    d.putAndInsertString(DCM_StudyInstanceUID, "1.2.826.0.1.3680043.10.9");
    d.putAndInsertString(DCM_SeriesInstanceUID, series.c_str());
    d.putAndInsertString(DCM_Modality, "CT");
    d.putAndInsertString(DCM_ImageType, "ORIGINAL\\PRIMARY\\AXIAL");
    d.putAndInsertString(DCM_PatientPosition, "HFS");
    d.putAndInsertString(DCM_PatientID, "P1");
    d.putAndInsertString(DCM_ImagePositionPatient, ("-8\\-8\\" + std::to_string(2 * n)).c_str());
    d.putAndInsertString(DCM_ImageOrientationPatient, "1\\0\\0\\0\\1\\0");
    d.putAndInsertString(DCM_PixelSpacing, "2\\2");
    d.putAndInsertString(DCM_SliceThickness, "2");
    d.putAndInsertString(DCM_RescaleSlope, "1");
    d.putAndInsertString(DCM_RescaleIntercept, "-1024");
    d.putAndInsertString(DCM_PhotometricInterpretation, "MONOCHROME2");
    d.putAndInsertUint16(DCM_SamplesPerPixel, 1);
    d.putAndInsertUint16(DCM_Rows, 8);
    d.putAndInsertUint16(DCM_Columns, 8);
    d.putAndInsertUint16(DCM_BitsAllocated, 16);
    d.putAndInsertUint16(DCM_BitsStored, 12);
    d.putAndInsertUint16(DCM_HighBit, 11);
    d.putAndInsertUint16(DCM_PixelRepresentation, 0);
    std::vector<Uint16> pixels;
    for (int p = 0; p < 64; ++p)
        pixels.push_back(Uint16(16 * p + n));
    d.putAndInsertUint16Array(DCM_PixelData, pixels.data(), pixels.size());
    return d;
}

}  // namespace vicon::fuzz
