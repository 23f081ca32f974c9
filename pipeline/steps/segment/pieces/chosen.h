#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "grid/run_labels.h"
#include "segment/pieces/candidates.h"
#include "segment/pieces/ordering.h"
#include "vicon/steps/lumen_plan.h"

namespace vicon::steps {

/// The parts that a person's cuts separate from the larger rest.
/// @param around_cuts voxels of lumen beside each cut, as cutAcross() gives them
std::set<int> separated(const RunLabels& lumen, const std::vector<std::vector<Index3>>& around_cuts);

/// The scan's part around the chosen components, with their labels and the rim.
InsideVolume cropTo(const InsideVolume& labels, const RunLabels& lumen, const std::set<int>& chosen, int margin);

/// @param reversed entered through its second tip
LumenPiece pieceFor(const Candidate& candidate, bool reversed);

/// All candidates, and which became pieces, for the step's record.
nlohmann::json describe(const std::vector<Candidate>& candidates, const Ordering& ordering);

}  // namespace vicon::steps
