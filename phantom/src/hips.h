#pragma once

#include <cstdint>

#include "vicon/core/progress.h"
#include "vicon/core/volume.h"

namespace vicon::phantom {

/// Adds to a scan what its slices through the hips show where few photons pass them: streaks of noise from hip to hip,
/// and, of what is denser than bone, the bands of hardened and starved rays. Rays are followed through each slice, and
/// what they lack is projected back as a scanner does. Padding stays.
void addHipArtefacts(HuVolume& hu, std::uint64_t seed, Progress& progress);

}  // namespace vicon::phantom
