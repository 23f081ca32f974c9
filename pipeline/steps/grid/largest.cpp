#include "vicon/steps/largest.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>

namespace vicon::steps {
namespace {

/// Of `count` values or of `so_far`. Several at once: one at a time each waits for the one before.
float largestIn(const float* values, std::size_t count, float so_far)
{
    std::array<float, 16> lanes;
    lanes.fill(so_far);
    std::size_t n = 0;
    for (; n + lanes.size() <= count; n += lanes.size())
        for (std::size_t lane = 0; lane < lanes.size(); ++lane)
            lanes[lane] = std::max(lanes[lane], values[n + lane]);
    for (; n < count; ++n)
        lanes[0] = std::max(lanes[0], values[n]);
    return *std::max_element(lanes.begin(), lanes.end());
}

}  // namespace

float largestOf(const FieldVolume& field)
{
    if (field.voxels.empty())
        return 0;
    const float* values = field.voxels.data();
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, field.voxels.size(), std::size_t(1) << 16), values[0],
        [&](const auto& part, float so_far) { return largestIn(values + part.begin(), part.size(), so_far); },
        [](float a, float b) { return std::max(a, b); });
}

}  // namespace vicon::steps
