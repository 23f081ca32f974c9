#pragma once

#include <cstdint>
#include <vector>

#include "tissue/fluid_density.h"
#include "tissue/levels.h"
#include "vicon/steps/tissue.h"

namespace vicon::steps {

/// Betters the fraction of tissue where gas, fluid and wall meet, however fluid has risen along the wall or clings
/// under it: what three materials are there is sought in parts of voxels (subvoxels.h), so that blurred they have the
/// densities of the scan.
/// @param near 1 where gas and fluid both are near, and no stool
/// @param blur_voxels of the point spread, standard deviation
void settleJunctions(const Mixture& mixture, const FluidDensity& fluid, const DownAxis& down,
                     const std::vector<std::uint8_t>& near, double blur_voxels, double noise_hu, TissueVolume& tissue);

}  // namespace vicon::steps
