#include "vicon/ingest/acquisition_facts.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "dataset.h"
#include "vicon/dicom/dicom_setup.h"
#include "vicon/dicom/load_file.h"

namespace vicon::ingest {
namespace {

struct ImageFacts {
    std::string reason, contrast;
    std::optional<double> ctdi_mgy, height_mm;
};

/// Along the normal of the images.
std::optional<double> heightOf(const Dataset& d)
{
    double position[3], axes[6];
    for (unsigned long n = 0; n < 3; ++n)
        if (const auto value = d.number(DCM_ImagePositionPatient, n))
            position[n] = *value;
        else
            return std::nullopt;
    for (unsigned long n = 0; n < 6; ++n)
        if (const auto value = d.number(DCM_ImageOrientationPatient, n))
            axes[n] = *value;
        else
            return std::nullopt;
    const Vector3 normal = cross(Vector3{axes[0], axes[1], axes[2]}, Vector3{axes[3], axes[4], axes[5]});
    return dot(Point3{position[0], position[1], position[2]} - Point3{}, normal);
}

std::string reasonOf(const Dataset& d)
{
    for (const DcmTagKey& tag : {DCM_ReasonForTheRequestedProcedure, DCM_RETIRED_ReasonForStudy})
        if (std::string text = d.text(tag); !text.empty())
            return text;
    if (const auto request = d.item(DCM_RequestAttributesSequence))
        for (const DcmTagKey& tag : {DCM_ReasonForTheRequestedProcedure, DCM_RequestedProcedureDescription})
            if (std::string text = request->text(tag); !text.empty())
                return text;
    return d.text(DCM_RequestedProcedureDescription);
}

ImageFacts factsOf(const std::filesystem::path& file)
{
    DcmFileFormat format;
    if (loadFile(format, file, DCM_MaxReadLength, DCM_PixelData).bad())
        return {};
    const Dataset d(*format.getDataset());
    return {reasonOf(d), d.text(DCM_ContrastBolusAgent), d.number(DCM_CTDIvol), heightOf(d)};
}

std::optional<double> doseOf(const std::vector<ImageFacts>& images)
{
    if (images.size() < 2)
        return std::nullopt;
    double sum_mgy = 0;
    std::vector<double> heights_mm;
    for (const ImageFacts& image : images) {
        if (!image.ctdi_mgy || *image.ctdi_mgy <= 0 || !image.height_mm)
            return std::nullopt;
        sum_mgy += *image.ctdi_mgy;
        heights_mm.push_back(*image.height_mm);
    }
    const auto [least, most] = std::minmax_element(heights_mm.begin(), heights_mm.end());
    const auto count = double(images.size());
    const double length_mm = (*most - *least) * count / (count - 1);  // with the half slices at both ends
    return sum_mgy / count * length_mm / 10;
}

}  // namespace

AcquisitionFacts acquisitionFacts(const std::filesystem::path& folder, const std::vector<InstanceRecord>& instances)
{
    setUpDicom();
    std::vector<ImageFacts> images(instances.size());
    tbb::parallel_for(std::size_t(0), instances.size(),
                      [&](std::size_t n) { images[n] = factsOf(folder / instances[n].file); });
    AcquisitionFacts facts{.dose_mgy_cm = doseOf(images)};
    for (const ImageFacts& image : images) {
        if (facts.reason.empty())
            facts.reason = image.reason;
        if (facts.contrast.empty())
            facts.contrast = image.contrast;
    }
    return facts;
}

}  // namespace vicon::ingest
