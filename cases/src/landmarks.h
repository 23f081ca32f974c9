#pragma once

#include <vector>

#include "vicon/cases/station_map.h"

namespace vicon {

/// A place that both scans know by itself.
struct LandmarkPair {
    double from_mm = 0, to_mm = 0;
    double deviation_mm = 0;  ///< of where the one scan's lies in the other
};

/// Where a part lies; null where the scan does not show it.
const ColonPartRange* rangeOf(const ColonPartRanges& parts, ColonPart part);

/// The ends, and between them what both scans know: the rectum's end, the descending colon's begin, the flexures'
/// middles. Ascending in both.
std::vector<LandmarkPair> sharedLandmarks(const ColonProfile& from, const ColonProfile& to);

}  // namespace vicon
