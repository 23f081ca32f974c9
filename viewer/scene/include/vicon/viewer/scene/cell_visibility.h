#pragma once

#include <vector>

#include "vicon/viewer/model/visibility.h"
#include "vicon/viewer/scene/prepared_scan.h"

namespace vicon::viewer {

/// Which cells of a scan may be seen from an eye: the scan's subdivision and labels put to Visibility.
class CellVisibility {
public:
    /// Reads segments.mha and subdivision.json. Throws as PreparedScan does.
    explicit CellVisibility(const PreparedScan& scan);

    /// The segment of the voxel that holds a point; 0 outside.
    int segmentAt(Point3 p) const;
    /// Numbers of the segments to draw; empty (all) where the eye is outside the lumen.
    std::vector<int> segmentsSeen(const Pose& pose, const Lens& lens) const;
    const Visibility& visibility() const { return visibility_; }

private:
    PreparedScan scan_;
    Visibility visibility_;
};

}  // namespace vicon::viewer
