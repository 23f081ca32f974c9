#pragma once

#include <cstdint>
#include <vector>

#include "vicon/core/subdivision.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

/// The part of the skeleton that a label stands for.
struct LabelledPiece {
    double from_station_mm = 0;
    double to_station_mm = 0;
    int piece = -1;  ///< number of the skeleton's piece; -1: a part of the lumen that nothing joins to the skeleton
};

struct NumberedSegments {
    SegmentVolume segments;
    std::vector<SegmentInfo> infos;     ///< in order of number
    std::vector<LabelledPiece> pieces;  ///< of each segment, in order of number
};

/// Makes segments of a labelling: each 26-connected component of a label that holds an anchor is a segment, and so is
/// each label's largest component when none does. Any other component goes to the segment that it touches most, or
/// becomes a segment where it touches none. Numbers follow the stations.
///
/// @param label of every voxel of `inside`, 1..pieces.size(); 0 exactly where outside
/// @param anchors voxels of the skeleton
/// Throws Error{bad_input} for more than 65535 segments.
NumberedSegments numberSegments(const InsideVolume& inside, const std::vector<std::uint16_t>& label,
                                const std::vector<LabelledPiece>& pieces, const std::vector<std::size_t>& anchors);

}  // namespace vicon::steps
