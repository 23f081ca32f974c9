#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/core/geometry.h"

namespace vicon::report {

/// An image that came with the study.
struct SourceImage {
    std::string series_uid, sop_class, sop_uid;
};

/// An image and where its pixels lie.
struct ImagePlane {
    Point3 origin_mm;  ///< the centre of its first pixel
    Vector3 along_row, along_column;
    double column_step_mm = 0, row_step_mm = 0;  ///< from column to column, from row to row
    int rows = 0, columns = 0;
    SourceImage image;

    Vector3 normal() const { return cross(along_row, along_column); }
    double height_mm(Point3 point_mm) const { return dot(point_mm - origin_mm, normal()); }
};

/// The images of a scan by where they lie.
class SourceImages {
public:
    /// Reads their headers. An image that does not say where it lies is left out.
    SourceImages(const std::filesystem::path& folder, const std::vector<InstanceRecord>& instances);
    /// The image whose plane is nearest to a point; nothing where there is none.
    std::optional<SourceImage> nearest(Point3 point_mm) const;

    const std::vector<ImagePlane>& planes() const { return planes_; }

private:
    std::vector<ImagePlane> planes_;
};

}  // namespace vicon::report
