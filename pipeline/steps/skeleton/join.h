#pragma once

#include "skeleton/smooth.h"

namespace vicon::steps {

/// Joins two curves over a collapsed part. The line that joins them follows the cord of the collapsed bowel in its
/// middle and the two curves as far as they are sure; between these, where the lumen closes, often to one side, it goes
/// on as evenly as their bends allow. The curves' own ends lay where the wall was seen from one side only: they are
/// moved to the middle of the lumen again, now that the line goes on. What of the line lies in the lumen is added to
/// the curves, the rest is returned.
/// @param way through the cord, from where it leaves the lumen to where it enters it again; no more than these two
///        places where no cord was seen: then the curves alone lead on
Polyline joined(Polyline& before, const Polyline& way, Polyline& after, const DistanceProbe& open,
                const SkeletonOptions& options);

}  // namespace vicon::steps
