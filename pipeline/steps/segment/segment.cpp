#include "vicon/steps/segment.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "grid/sharp_kernel.h"
#include "segment/as_is.h"
#include "segment/automatic.h"
#include "segment/binary.h"
#include "segment/verdict.h"
#include "vicon/steps/noise.h"

namespace vicon::steps {
namespace {

Segmentation measured(Segmentation result, Progress& progress)
{
    const double voxel_ml = result.inside.grid.voxelVolume_mm3() / 1000;
    const auto count = [&](std::uint8_t label) {
        return double(std::count(result.inside.voxels.begin(), result.inside.voxels.end(), label)) * voxel_ml;
    };
    result.measures["gas_ml"] = count(kGas);
    result.measures["fluid_ml"] = count(kFluid);
    result.measures["pieces"] = result.plan.pieces.size();
    result.measures["bridges"] = toJson(result.plan)["bridges"];
    progress.report(1, "segmented");
    return result;
}

/// Of a sharp kernel's densities those that a usual one would have made are segmented.
Segmentation segmentSoftened(const HuVolume& volume, const InsideVolume* given, Vector3 gravity,
                             const SegmentOptions& options, Progress& progress)
{
    options.densities.require(true);
    const std::optional<SoftenedDensities> soft = softened(volume, options.densities);
    if (!soft)
        return segmentAsIs(volume, given, gravity, options, progress);
    Segmentation result = segmentAsIs(soft->hu, given, gravity, options, progress);
    result.measures["overshoot_hu"] = soft->overshoot_hu;
    result.measures["acquired_noise_hu"] = softTissueNoise(volume);
    note(result, "a sharp kernel: edges overshoot by " + std::to_string(std::lround(soft->overshoot_hu)) +
                     " HU; the wall was sought in softened densities");
    return result;
}

}  // namespace

Segmentation segmentAsIs(const HuVolume& volume, const InsideVolume* given, Vector3 gravity,
                         const SegmentOptions& options, Progress& progress)
{
    if (given)
        return measured(segmentGiven(volume, *given, gravity, options, progress), progress);
    return measured(options.method == SegmentMethod::binary ? segmentBinary(volume, options, progress)
                                                            : segmentAutomatically(volume, gravity, options, progress),
                    progress);
}

Segmentation segmentColon(const HuVolume& volume, Vector3 gravity, const SegmentOptions& options, Progress& progress)
{
    return options.method == SegmentMethod::binary ? segmentAsIs(volume, nullptr, gravity, options, progress)
                                                   : segmentSoftened(volume, nullptr, gravity, options, progress);
}

Segmentation segmentGivenColon(const HuVolume& volume, const InsideVolume& given, Vector3 gravity,
                               const SegmentOptions& options, Progress& progress)
{
    return segmentSoftened(volume, &given, gravity, options, progress);
}

}  // namespace vicon::steps
