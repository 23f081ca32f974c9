#pragma once

#include "vicon/core/progress.h"
#include "vicon/core/volume.h"
#include "vicon/steps/lumen_plan.h"
#include "vicon/steps/segment.h"

namespace vicon::steps {

/// Replaces each bridge of the plan by the way through the middle of the collapsed bowel: a cord of soft tissue in fat,
/// found at a few voxels' resolution between the two tips. Afterwards the bridge reaches from where that way leaves
/// the lumen of one piece to where it enters the next, and its length and confidence are those of that way.
/// @param inside the lumen of the pieces, on the lattice of `volume`
void followCords(const HuVolume& volume, const InsideVolume& inside, const SegmentOptions& options, LumenPlan& plan,
                 Progress& progress);

/// How many millimetres of the way between two tips, from lumen to lumen, are no collapsed bowel: fat, bone, gas of
/// neither piece. The way is sought as by followCords(); `inside` may hold more than the two pieces.
double fatBetween_mm(const HuVolume& volume, const InsideVolume& inside, const WallDensities& densities, Point3 from,
                     Point3 to, Progress& progress);

/// How likely a way of that length is the collapsed bowel when this share of it lies in soft tissue; fills confidence,
/// certain and reason.
/// @param longest_sure_mm a longer bridge is uncertain
void judgeBridge(Bridge& bridge, double soft_share, double longest_sure_mm);

}  // namespace vicon::steps
