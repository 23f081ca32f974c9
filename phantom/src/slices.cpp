#include "slices.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "anatomy.h"

namespace vicon::phantom {

std::pair<PhantomOptions, int> withThinSlices(const PhantomOptions& options)
{
    constexpr double kThickest_mm = 1;
    if (options.protocol.thickness_mm <= 0)
        return {options, 1};
    PhantomOptions thin = options;
    const int of_each = int(std::ceil(options.protocol.thickness_mm / kThickest_mm - 1e-9));
    thin.spacing_mm[2] = options.protocol.thickness_mm / of_each;
    thin.size[2] = of_each * int(std::lround(kHeightMm / options.protocol.thickness_mm));
    return {thin, of_each};
}

HuVolume averagedSlices(HuVolume thin, int of_each)
{
    if (of_each == 1)
        return thin;
    Grid grid = thin.grid;
    grid.size[2] /= of_each;
    grid.spacing_mm[2] *= of_each;
    grid.origin_mm += thin.grid.axis[2] * (thin.grid.spacing_mm[2] * (of_each - 1) / 2);
    HuVolume out(grid);
    tbb::parallel_for(0, grid.size[2], [&](int k) {
        for (int j = 0; j < grid.size[1]; ++j)
            for (int i = 0; i < grid.size[0]; ++i) {
                int sum = 0;
                bool padding = false;
                for (int n = 0; n < of_each; ++n) {
                    const std::int16_t v = thin.at({i, j, k * of_each + n});
                    padding = padding || v == kPaddingHu;
                    sum += v;
                }
                out.at({i, j, k}) = padding ? kPaddingHu : std::int16_t(std::lround(double(sum) / of_each));
            }
    });
    return out;
}

void addTo(HuVolume& hu, const HuVolume& more_hu)
{
    for (std::size_t n = 0; n < hu.voxels.size(); ++n)
        if (hu.voxels[n] != kPaddingHu)
            hu.voxels[n] = std::int16_t(std::clamp(hu.voxels[n] + more_hu.voxels[n], -1023, 3071));
}

}  // namespace vicon::phantom
