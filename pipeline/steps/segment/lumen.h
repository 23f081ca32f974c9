#pragma once

#include <vector>

#include "grid/run_labels.h"
#include "segment/body.h"
#include "vicon/core/volume.h"
#include "vicon/steps/segment.h"

namespace vicon::steps {

/// Gas inside the body: every 6-connected component below the threshold.
/// Faces only: a wall one voxel thick leaks over corners.
RunLabels findGas(const HuVolume& volume, const Body& body, double gas_below_hu);

/// Whether a component of gas is lung, by its density and place.
bool isLung(const RunComponent& gas, const Grid& grid);

/// Labels the components of gas that may be bowel or stomach with kGas.
/// @param always components that are taken whatever they look like
InsideVolume labelGas(const HuVolume& volume, const RunLabels& gas, const std::vector<int>& always);

/// Extends kGas over the blurred edge to the half-way density.
void growToWall(const HuVolume& volume, double wall_hu, InsideVolume& labels);

}  // namespace vicon::steps
