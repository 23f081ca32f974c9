#pragma once

#include "vicon/core/progress.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

/// Where the patient is, on a grid `factor` times coarser than the scan: enough for "inside the body" and cheap.
struct Body {
    int factor = 1;
    Volume<std::uint8_t> inside;  ///< 1 well inside the skin (a coarse voxel away from it), lungs and bowel included
    Volume<std::int16_t> mean_hu;
    Point3 lower_mm;  ///< bounding box of `inside`
    Point3 upper_mm;
    bool empty() const { return !(lower_mm.x < upper_mm.x); }
    bool holds(int j, int k, int coarse_i) const { return inside.at({coarse_i, j / factor, k / factor}) != 0; }
};

/// The body: above kBody_hu, opened to lose the table, its largest component, holes filled in each axial slice; and
/// bowel so close under the skin that the opening laid it open.
/// The outside air is entered from the x and y faces only: lungs and colon may leave the scan through its ends.
Body findBody(const HuVolume& volume, Progress& progress);

}  // namespace vicon::steps
