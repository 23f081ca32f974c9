#include "segment/binary.h"

#include <cmath>
#include <limits>
#include <optional>

#include "segment/body.h"
#include "segment/constants.h"
#include "segment/field_of_view.h"
#include "segment/lumen.h"
#include "segment/points.h"
#include "segment/region_grower.h"
#include "segment/verdict.h"
#include "vicon/steps/noise.h"

namespace vicon::steps {
namespace {

/// A voxel of the largest piece of gas that is no lung.
std::optional<Index3> largestPiece(const HuVolume& volume, const Body& body, double iso_hu)
{
    const RunLabels gas = findGas(volume, body, iso_hu);
    int best = -1;
    for (std::size_t n = 0; n < gas.components.size(); ++n)
        if (!isLung(gas.components[n], volume.grid) &&
            (best < 0 || gas.components[n].voxels > gas.components[std::size_t(best)].voxels))
            best = int(n);
    for (int k = 0; k < gas.size[2]; ++k)
        for (int j = 0; j < gas.size[1]; ++j)
            for (std::size_t r = gas.row_begin[gas.row(j, k)]; r < gas.row_begin[gas.row(j, k) + 1]; ++r)
                if (int(gas.runs[r].label) == best)
                    return Index3{gas.runs[r].begin, j, k};
    return std::nullopt;
}

}  // namespace

Segmentation segmentBinary(const HuVolume& volume, const SegmentOptions& options, Progress& progress)
{
    progress.report(0, "body");
    const Body body = findBody(volume, progress);
    if (body.empty())
        return organAbsent("there is no body in the scan");
    RegionGrower grower(volume, body, RegionGrower::Padding::counts);
    const double lowest_hu = std::numeric_limits<std::int16_t>::min(), below_iso_hu = std::trunc(options.iso_hu) - 1;
    const std::optional<Index3> seed = options.seed.empty()
                                           ? largestPiece(volume, body, options.iso_hu)
                                           : grower.seedAt(options.seed.front(), kCatch_mm, lowest_hu, below_iso_hu);
    if (!seed)
        return organAbsent(options.seed.empty() ? "nothing in the body lies below the iso value"
                                                : "nothing at the seed point lies below the iso value");
    Segmentation result;
    result.inside = grower.grow(*seed, lowest_hu, below_iso_hu, kMargin_voxels).mask;
    result.measures["noise_hu"] = softTissueNoise(volume);
    progress.report(0.7, "ends");
    result.plan = planForMask(result.inside);
    judgeSegmentation(result, options, body, lumenCut_mm2(volume, result.inside));
    return result;
}

}  // namespace vicon::steps
