#include "segment/wall/leaks.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "grid/thin_holes.h"
#include "segment/constants.h"

namespace vicon::steps {

std::vector<Point3> closeLeaks(const HuVolume& volume, const WallDensities& densities, InsideVolume& labels)
{
    const auto slice = std::size_t(labels.grid.size[0]) * std::size_t(labels.grid.size[1]);
    InsideVolume gas(labels.grid, kOutside);
    Volume<std::uint8_t> fraction(labels.grid, UINT8_MAX);
    tbb::parallel_for(std::size_t(0), std::size_t(labels.grid.size[2]), [&](std::size_t k) {
        for (std::size_t n = k * slice; n < (k + 1) * slice; ++n)
            if (labels.voxels[n] == kGas) {
                const double part = (volume.voxels[n] - kAir_hu) / (densities.tissue_hu - kAir_hu);
                gas.voxels[n] = kGas;
                fraction.voxels[n] = std::uint8_t(std::lround(std::clamp(part, 0.0, 1.0) * UINT8_MAX));
            }
    });
    std::vector<Point3> closed;
    for (const ThinHole& hole : findThinHoles(fraction, gas)) {
        for (const std::size_t n : hole.voxels)
            labels.voxels[n] = kOutside;
        closed.push_back(middleOf(hole, labels.grid));
    }
    return closed;
}

}  // namespace vicon::steps
