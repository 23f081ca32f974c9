#pragma once

#include "tissue/mixture.h"
#include "tissue/stool.h"
#include "vicon/core/mottled_tagging.h"

namespace vicon::steps {

/// Finds where fluid is not one fluid: its densities differ by more than noise within a few millimetres, away from its
/// edges. No block stands alone. And where stool lies.
/// @param noise_hu standard deviation of the noise in soft tissue
MottledTagging findMottled(const Mixture& mixture, const Stool& stool, double noise_hu);

}  // namespace vicon::steps
