#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "vicon/cases/case_store.h"
#include "vicon/core/geometry.h"

namespace vicon::report {

/// An image that came with the study.
struct SourceImage {
    std::string series_uid, sop_class, sop_uid;
};

/// The images of a scan by where they lie.
class SourceImages {
public:
    /// Reads their headers. An image that does not say where it lies is left out.
    SourceImages(CaseStore& store, const ScanRecord& scan);
    /// The image whose plane is nearest to a point; nothing where there is none.
    std::optional<SourceImage> nearest(Point3 point_mm) const;

private:
    struct Plane {
        Point3 origin_mm;
        Vector3 normal;
        SourceImage image;
    };
    std::vector<Plane> planes_;
};

}  // namespace vicon::report
