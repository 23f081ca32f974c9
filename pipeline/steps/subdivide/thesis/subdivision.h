#pragma once

#include <vector>

#include "subdivide/flood.h"
#include "vicon/steps/subdivide.h"

namespace vicon::steps {

/// The thesis' subdivision: portals across the paths by Algorithm 3.1 (options.approach "local") or by a dynamic
/// programme that minimises the sum of the segments' deviations in size and the portals' badness over all selections
/// (approach "global"), and the parts of the lumen between them.
/// @param segments specified number of segments over all paths
Labelling thesisPieces(const InsideVolume& inside, const Skeleton& skeleton, const std::vector<Path>& paths,
                       const SubdivideOptions& options, int segments, Progress& progress);

}  // namespace vicon::steps
