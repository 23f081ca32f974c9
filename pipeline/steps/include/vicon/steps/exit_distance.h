#pragma once

#include "vicon/core/progress.h"
#include "vicon/core/skeleton.h"
#include "vicon/core/skeleton_tree.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

/// Distance from exit: the geodesic distance in mm, inside the lumen, from every inside voxel to the rectal end of the
/// skeleton, as the viscosity solution of the Eikonal equation |grad T| = 1 by first-order upwind differences (Sethian,
/// A fast marching level set method for monotonically advancing fronts, 1996). -1 outside.
///
/// 0 at the inside voxel nearest to the rectal end. A bridge continues the distance by its length. Where two parts of
/// the lumen that are not neighbours along the skeleton touch, the front does not pass: there is no short cut through a
/// contact. Inside voxels that neither 6 nor 26 neighbours nor a bridge join to the skeleton get the distance of the
/// nearest skeleton point plus the way from there, so every inside voxel has a finite distance.
/// Same grid as `inside`. The result does not depend on the number of threads.
/// Throws Error{bad_input} when the skeleton is empty or the grid holds no inside voxel.
FieldVolume exitDistance(const InsideVolume& inside, const Skeleton& skeleton, Progress& progress);

/// The same from the root of a tree. Its branches are taken not to touch: a contact is a short cut.
FieldVolume exitDistance(const InsideVolume& inside, const SkeletonTree& tree, Progress& progress);

}  // namespace vicon::steps
