#include "segment_scan.h"

#include "vicon/core/error.h"
#include "vicon/scan_files/volume_file.h"

namespace vicon::pipeline {
namespace {

InsideVolume givenMask(const GivenLumen& lumen)
try {
    return scan_files::readVolume<std::uint8_t>(lumen.mask_file);
} catch (const Error& e) {
    if (e.code() == ErrorCode::no_memory)
        throw;
    throw Error(ErrorCode::bad_input, "the given lumen is lost or damaged", lumen.mask_file.string(),
                "give it again with 'vicon import --mask CASE SCAN FILE', or 'none' as FILE");
}

}  // namespace

steps::Segmentation segmentScan(const StepInputs& inputs, const steps::OrganOptions& organ, const HuVolume& volume,
                                Progress& progress)
{
    const auto options = inputs.config.get<steps::SegmentOptions>();
    if (!organ.isColon())
        return steps::segmentOrgan(volume, organ, progress);
    if (inputs.lumen)
        return steps::segmentGivenColon(volume, givenMask(*inputs.lumen), inputs.gravity, options, progress);
    return steps::segmentColon(volume, inputs.gravity, options, progress);
}

}  // namespace vicon::pipeline
