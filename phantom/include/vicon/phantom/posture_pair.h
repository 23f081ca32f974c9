#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vicon/core/colon_parts.h"
#include "vicon/core/scan_quality.h"

namespace vicon::phantom {

/// What the pipeline would find along the centreline of a scan.
struct PostureProfile {
    double length_mm = 0;
    LumenAlong along;                  ///< width, as the step quality keeps it
    std::vector<double> clearance_mm;  ///< from the centreline to the wall, at each mm; 0 on bridges
    /// From the centreline to the wall in 36 directions evenly about it, at each mm; 0 on bridges.
    std::vector<std::array<float, 36>> relief_mm;
    std::vector<StationRange> bridges;  ///< over collapsed parts
    ColonPartRanges parts;              ///< as far off as those that are found in scans
};

/// One colon in two postures, without a scan: made in milliseconds, so that thousands can be.
struct PosturePair {
    PostureProfile first, second;
    /// Stations of the same places of the wall, ascending; one for each mm of the patient's colon that both show.
    std::vector<double> first_mm, second_mm;
};

/// The phantom's own folds and haustra, drawn out by 0.7 to 1.4 from one posture to the other, which varies along the
/// way; distended by 0.6 to 1.5, turned by up to 80 degrees, with collapsed parts of 10 to 60 mm of their own. Folds
/// differ in depth from posture to posture, one in twelve is missing in one of them. Centrelines end up to 15 mm short,
/// their widths are noisy, their
/// frames wander about them, and the parts' ends lie as far off as they do in scans.
PosturePair drawPosturePair(std::uint64_t seed);

}  // namespace vicon::phantom
