#include "segment/binary.h"

#include <algorithm>

#include "segment/body.h"
#include "segment/constants.h"
#include "segment/field_of_view.h"
#include "segment/lumen.h"
#include "segment/points.h"
#include "segment/verdict.h"
#include "vicon/steps/noise.h"

namespace vicon::steps {
namespace {

/// The component of the seed, or the largest that is no lung; -1 when there is none.
int chosenComponent(const RunLabels& gas, const Grid& grid, const std::vector<Point3>& seeds)
{
    if (!seeds.empty()) {
        const std::vector<int> at = componentsAt(gas, grid, {seeds.front()});
        return at.empty() ? -1 : at.front();
    }
    int best = -1;
    for (std::size_t n = 0; n < gas.components.size(); ++n)
        if (!isLung(gas.components[n], grid) &&
            (best < 0 || gas.components[n].voxels > gas.components[std::size_t(best)].voxels))
            best = int(n);
    return best;
}

InsideVolume cropped(const RunLabels& gas, const Grid& grid, int chosen)
{
    const RunComponent& c = gas.components[std::size_t(chosen)];
    const auto from = [](int lower) { return std::max(0, lower - kMargin_voxels); };
    const auto to = [&](int upper, std::size_t axis) { return std::min(grid.size[axis], upper + kMargin_voxels + 1); };
    const Index3 lower{from(c.lower.i), from(c.lower.j), from(c.lower.k)};
    Grid out = grid;
    out.size = {to(c.upper.i, 0) - lower.i, to(c.upper.j, 1) - lower.j, to(c.upper.k, 2) - lower.k};
    out.origin_mm = grid.pointAt(lower);
    InsideVolume inside(out);
    gas.forEachRun([&](const VoxelRun& run, int j, int k) {
        if (int(run.label) == chosen)
            std::fill_n(&inside.at({run.begin - lower.i, j - lower.j, k - lower.k}), run.end - run.begin,
                        std::uint8_t(kGas));
    });
    return inside;
}

}  // namespace

Segmentation segmentBinary(const HuVolume& volume, const SegmentOptions& options, Progress& progress)
{
    progress.report(0, "body");
    const Body body = findBody(volume, progress);
    if (body.empty())
        return noColon("there is no body in the scan");
    const RunLabels gas = findGas(volume, body, options.iso_hu);
    const int chosen = chosenComponent(gas, volume.grid, options.seed);
    if (chosen < 0)
        return noColon(options.seed.empty() ? "nothing in the body lies below the iso value"
                                            : "nothing at the seed point lies below the iso value");
    Segmentation result;
    result.inside = cropped(gas, volume.grid, chosen);
    result.measures["noise_hu"] = softTissueNoise(volume);
    progress.report(0.7, "ends");
    result.plan = planForMask(result.inside);
    judgeSegmentation(result, options, body, lumenCut_mm2(volume, result.inside));
    return result;
}

}  // namespace vicon::steps
