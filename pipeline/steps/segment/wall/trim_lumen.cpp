#include "segment/wall/trim_lumen.h"

#include <algorithm>

#include "segment/constants.h"
#include "segment/lumen.h"

namespace vicon::steps {
namespace {

bool isCrumb(const RunComponent& part, const Grid& grid)
{
    return double(part.voxels) * grid.voxelVolume_mm3() / 1000 < kSpeck_ml;
}

void clearCrumbs(const RunLabels& lumen, InsideVolume& inside)
{
    lumen.forEachRun([&](const VoxelRun& run, int j, int k) {
        if (isCrumb(lumen.components[run.label], inside.grid))
            std::fill_n(&inside.at({run.begin, j, k}), run.end - run.begin, std::uint8_t(kOutside));
    });
}

}  // namespace

void trimLumen(const std::vector<std::size_t>& taken, int pieces, InsideVolume& inside)
{
    if (taken.empty())
        return;
    const RunLabels lumen = labelLumen(inside, Neighbours::faces);
    const auto parts = std::count_if(lumen.components.begin(), lumen.components.end(),
                                     [&](const RunComponent& part) { return !isCrumb(part, inside.grid); });
    if (parts > pieces)
        for (const std::size_t n : taken)
            inside.voxels[n] = kFluid;
    else
        clearCrumbs(lumen, inside);
}

}  // namespace vicon::steps
