#pragma once

#include <vector>

#include "subdivide/segments.h"

namespace vicon::steps {

/// The portals of a numbering: one for every two segments with voxels that are 26-neighbours, in order of the pair.
/// Gate and box enclose every face, edge and corner that the two share, dilated by a voxel diagonal.
std::vector<Portal> findPortals(const NumberedSegments& numbered);

/// How far from flat a portal is: the length of its box along the normal, without the dilation, in mm.
double thicknessOf(const Portal& portal, const Grid& grid);

}  // namespace vicon::steps
