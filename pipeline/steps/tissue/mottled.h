#pragma once

#include "tissue/mixture.h"
#include "vicon/core/mottled_tagging.h"

namespace vicon::steps {

/// Finds where fluid is not one fluid: its densities differ by more than noise within a few millimetres, away from its
/// edges. No block stands alone.
/// @param noise_hu standard deviation of the noise in soft tissue
MottledTagging findMottled(const Mixture& mixture, double noise_hu);

}  // namespace vicon::steps
