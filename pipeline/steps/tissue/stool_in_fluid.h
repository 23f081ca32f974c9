#pragma once

#include <cstddef>
#include <vector>

#include "tissue/levels.h"
#include "tissue/mixture.h"

namespace vicon::steps {

/// Voxels labelled as fluid, ascending, that are none: what hangs together with no pool and meets gas beside and below
/// it is a lump of stool, whose flat top passed for a level.
/// @param blur_mm standard deviation of the point spread, about
std::vector<std::size_t> stoolInFluid(const Mixture& mixture, const DownAxis& down, double blur_mm);

}  // namespace vicon::steps
