#include "source_images.h"

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include <cmath>

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

std::string text(DcmDataset& dataset, const DcmTagKey& tag)
{
    OFString value;
    dataset.findAndGetOFString(tag, value);
    return value.c_str();
}

}  // namespace

SourceImages::SourceImages(CaseStore& store, const ScanRecord& scan)
{
    const auto folder = store.scanFolder(scan.case_id, scan.id) / "dicom";
    for (const InstanceRecord& instance : store.instances(scan.case_id, scan.id)) {
        DcmFileFormat format;
        if (format
                .loadFileUntilTag((folder / instance.file).c_str(), EXS_Unknown, EGL_noChange, DCM_MaxReadLength,
                                  ERM_autoDetect, DCM_SamplesPerPixel)
                .bad())
            continue;
        DcmDataset& d = *format.getDataset();
        const auto origin = numbers<3>(d, DCM_ImagePositionPatient);
        const auto axes = numbers<6>(d, DCM_ImageOrientationPatient);
        if (!origin || !axes)
            continue;
        const auto& a = *axes;
        planes_.push_back({{(*origin)[0], (*origin)[1], (*origin)[2]},
                           {a[1] * a[5] - a[2] * a[4], a[2] * a[3] - a[0] * a[5], a[0] * a[4] - a[1] * a[3]},
                           {text(d, DCM_SeriesInstanceUID), text(d, DCM_SOPClassUID), instance.sop_uid}});
    }
}

std::optional<SourceImage> SourceImages::nearest(Point3 point_mm) const
{
    const auto distance = [&](const Plane& plane) {
        return std::abs((point_mm.x - plane.origin_mm.x) * plane.normal.x +
                        (point_mm.y - plane.origin_mm.y) * plane.normal.y +
                        (point_mm.z - plane.origin_mm.z) * plane.normal.z);
    };
    const auto found = std::min_element(planes_.begin(), planes_.end(),
                                        [&](const Plane& a, const Plane& b) { return distance(a) < distance(b); });
    return found == planes_.end() ? std::nullopt : std::optional(found->image);
}

}  // namespace vicon::report
