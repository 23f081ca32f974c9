#pragma once

#include <cstdint>

#include "vicon/core/progress.h"
#include "vicon/core/volume.h"

namespace vicon::phantom {

struct ImagingOptions {
    std::uint64_t seed = 1;
    double blur_mm = 0.65;  ///< sigma of the Gaussian point spread, the same in all directions
    double noise_hu = 25;   ///< standard deviation after filtering, at the middle of the trunk
    double overshoot = 0;  ///< of the slices' kernel: what a Gaussian of twice the width would blur away, so many times
};

/// What a scanner makes of an ideal picture: the point spread, and noise that was filtered by it. Padding stays. Every
/// voxel's noise depends on the seed and its index alone.
HuVolume imageScene(const HuVolume& scene, const ImagingOptions& options, Progress& progress);

}  // namespace vicon::phantom
