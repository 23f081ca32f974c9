#pragma once

#include "tissue/levels.h"
#include "vicon/steps/tissue.h"

namespace vicon::steps {

/// Edges between gas and tissue and between tissue and fluid: the fraction of tissue that a voxel's density tells when
/// it holds tissue and one of the two. Where gas lies beside fluid without tissue between them the density rises more
/// steeply than any wall lets it, and there is none; but gas does not stay under fluid without a wall. All tissue
/// farther than about 5 mm from the lumen.
/// @param blur_voxels sigma of the point spread
TissueVolume fractionAtEdges(const Mixture& mixture, const FluidDensity& fluid, const DownAxis& down,
                             double blur_voxels);

}  // namespace vicon::steps
