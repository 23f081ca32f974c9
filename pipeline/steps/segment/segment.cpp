#include "vicon/steps/segment.h"

#include <algorithm>

#include "segment/automatic.h"
#include "segment/binary.h"

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

}  // namespace

Segmentation segmentColon(const HuVolume& volume, Vector3 gravity, const SegmentOptions& options, Progress& progress)
{
    return measured(options.method == SegmentMethod::binary ? segmentBinary(volume, options, progress)
                                                            : segmentAutomatically(volume, gravity, options, progress),
                    progress);
}

Segmentation segmentGivenColon(const HuVolume& volume, const InsideVolume& given, Vector3 gravity,
                               const SegmentOptions& options, Progress& progress)
{
    return measured(segmentGiven(volume, given, gravity, options, progress), progress);
}

}  // namespace vicon::steps
