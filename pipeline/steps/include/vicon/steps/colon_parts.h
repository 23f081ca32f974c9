#pragma once

#include <string>

#include "vicon/core/colon_parts.h"
#include "vicon/core/skeleton.h"

namespace vicon::steps {

struct FoundParts {
    ColonPartRanges ranges;  ///< all eight, from station 0 to the end of the skeleton; empty: not known
    std::string reason;      ///< why they are not known; empty otherwise
};

/// Names the parts of the colon from the shape of its skeleton in the patient's frame (LPS), so the patient's position
/// in the scanner does not matter.
///
/// The flexures are the upper corners of the frame that the colon makes: of all pairs in order from the rectum, the
/// points that lie highest and farthest to the left, and highest and farthest to the right. A flexure takes 40 mm to
/// either side of its corner. The sigmoid begins where the rectum first turns away from the head, and ends where the
/// descending colon, followed down from the splenic flexure, turns away from the feet. The caecum is the last 60 mm of
/// the lumen: the skeleton does not show the valve.
///
/// Not known: a skeleton that is empty, shorter than 700 mm, or whose flexures are not left and right of one another (a
/// colon cut by the field of view, a wrong order of pieces, a mirrored situs).
FoundParts findColonParts(const Skeleton& skeleton);

}  // namespace vicon::steps
