#include "source_images.h"

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>
#include <tbb/parallel_for.h>

#include <cmath>

#include "vicon/dicom/load_file.h"
#include "vicon/dicom/proper_values.h"

namespace vicon::report {
namespace {

/// So many numbers of an element; nothing where it has fewer.
template <std::size_t Count>
std::optional<std::array<double, Count>> numbers(DcmDataset& dataset, const DcmTagKey& tag)
{
    std::array<double, Count> values{};
    for (std::size_t n = 0; n < Count; ++n)
        if (dataset.findAndGetFloat64(tag, values[n], static_cast<unsigned long>(n)).bad())
            return std::nullopt;
    return values;
}

int size(DcmDataset& dataset, const DcmTagKey& tag)
{
    Uint16 value = 0;
    dataset.findAndGetUint16(tag, value);
    return value;
}

std::string textOf(DcmDataset& dataset, const DcmTagKey& tag)
{
    OFString value;
    dataset.findAndGetOFString(tag, value);
    return value.c_str();
}

std::optional<ImagePlane> planeOf(const std::filesystem::path& file, const std::string& sop_uid)
{
    DcmFileFormat format;
    if (loadFile(format, file, DCM_MaxReadLength, DCM_BitsAllocated).bad())
        return std::nullopt;
    DcmDataset& d = *format.getDataset();
    const auto origin = numbers<3>(d, DCM_ImagePositionPatient);
    const auto axes = numbers<6>(d, DCM_ImageOrientationPatient);
    if (!origin || !axes)
        return std::nullopt;
    const auto spacing = numbers<2>(d, DCM_PixelSpacing).value_or(std::array<double, 2>{});
    const auto& a = *axes;
    const SourceImage image{textOf(d, DCM_SeriesInstanceUID), textOf(d, DCM_SOPClassUID), sop_uid};
    for (const std::string& uid : {image.series_uid, image.sop_class, image.sop_uid})
        if (!isUid(uid))
            return std::nullopt;  // no reference can name it
    return ImagePlane{{(*origin)[0], (*origin)[1], (*origin)[2]},
                      {a[0], a[1], a[2]},
                      {a[3], a[4], a[5]},
                      spacing[1],
                      spacing[0],
                      size(d, DCM_Rows),
                      size(d, DCM_Columns),
                      image};
}

}  // namespace

SourceImages::SourceImages(const std::filesystem::path& folder, const std::vector<InstanceRecord>& instances)
{
    std::vector<std::optional<ImagePlane>> planes(instances.size());
    tbb::parallel_for(std::size_t(0), instances.size(),
                      [&](std::size_t n) { planes[n] = planeOf(folder / instances[n].file, instances[n].sop_uid); });
    for (auto& plane : planes)
        if (plane)
            planes_.push_back(std::move(*plane));
}

std::optional<SourceImage> SourceImages::nearest(Point3 point_mm) const
{
    const auto found = std::min_element(planes_.begin(), planes_.end(), [&](const ImagePlane& a, const ImagePlane& b) {
        return std::abs(a.height_mm(point_mm)) < std::abs(b.height_mm(point_mm));
    });
    return found == planes_.end() ? std::nullopt : std::optional(found->image);
}

}  // namespace vicon::report
