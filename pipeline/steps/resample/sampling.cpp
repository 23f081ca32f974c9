#include "resample/sampling.h"

#include <algorithm>
#include <cmath>

#include "vicon/core/error.h"

namespace vicon::steps {
namespace {

/// A sample nearer than this to a voxel, in voxels, is that voxel: what remains is rounding of the spacings.
constexpr double kOnVoxel = 1e-6;
constexpr double kMostAlongAxis = 1e6;

std::vector<Tap> tapsFor(int count, double spacing_mm, int acquired_count, double acquired_spacing_mm)
{
    std::vector<Tap> taps(static_cast<std::size_t>(count));
    for (int n = 0; n < count; ++n) {
        const double at = std::min(n * spacing_mm / acquired_spacing_mm, double(acquired_count - 1));
        int low = int(at);
        double weight = at - low;
        if (weight > 1 - kOnVoxel) {
            ++low;
            weight = 0;
        }
        const bool on = weight < kOnVoxel || low + 1 >= acquired_count;
        taps[std::size_t(n)] = {low, on ? low : low + 1, on ? 0.0F : float(weight)};
    }
    return taps;
}

int samplesAlong(int acquired_count, double acquired_spacing_mm, double spacing_mm)
{
    const double samples = std::floor((acquired_count - 1) * acquired_spacing_mm / spacing_mm + kOnVoxel) + 1;
    if (samples > kMostAlongAxis)
        throw Error(ErrorCode::no_memory, "the resampled volume would be more than a million voxels long", {},
                    "set resample.spacing_mm to a larger spacing");
    return int(samples);
}

}  // namespace

SliceRange Sampling::acquiredAround(SliceRange of_new, int margin) const
{
    return {std::max(0, taps[2][std::size_t(of_new.begin)].low - margin),
            std::min(acquired_size[2], taps[2][std::size_t(of_new.end - 1)].high + 1 + margin)};
}

Sampling sampleIsotropically(const Grid& acquired, double spacing_mm)
{
    Sampling sampling{.grid = acquired, .acquired_size = acquired.size};
    for (std::size_t d = 0; d < 3; ++d) {
        const int count = samplesAlong(acquired.size[d], acquired.spacing_mm[d], spacing_mm);
        double& ratio = sampling.acquired_in_new_voxels[d];
        ratio = acquired.spacing_mm[d] / spacing_mm;
        if (std::abs(ratio - 1) * acquired.size[d] < kOnVoxel)
            ratio = 1;
        sampling.grid.size[d] = count;
        sampling.grid.spacing_mm[d] = spacing_mm;
        sampling.taps[d] = tapsFor(count, spacing_mm, acquired.size[d], acquired.spacing_mm[d]);
    }
    return sampling;
}

}  // namespace vicon::steps
