#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "subdivide/flood.h"
#include "vicon/steps/subdivide.h"

namespace vicon::steps {

struct ThesisPieces {
    Labelling labelling;
    /// Of approach "global" what PortalChoice says of costs, over all paths: choice_cost, choice_cost_at_least and
    /// choice_cost_neighbours_only.
    nlohmann::json measures = nlohmann::json::object();
};

/// The thesis' subdivision: portals across the paths by Algorithm 3.1 (options.approach "local") or the selection of
/// least cost of all (approach "global", choosePortals()), and the parts of the lumen between them.
/// @param segments specified number of segments over all paths
ThesisPieces thesisPieces(const InsideVolume& inside, const Skeleton& skeleton, const std::vector<Path>& paths,
                          const SubdivideOptions& options, int segments, Progress& progress);

}  // namespace vicon::steps
