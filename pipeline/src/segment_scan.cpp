#include "segment_scan.h"

#include "vicon/core/error.h"
#include "vicon/scan_files/volume_file.h"
#include "vicon/steps/lumen_contrast.h"

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

SegmentedScan segmentMr(const StepInputs& inputs, const steps::OrganOptions& organ, const HuVolume& signal,
                        Progress& progress)
{
    if (!organ.isColon()) {
        SegmentedScan none;
        none.found.verdict = Verdict::absent;
        none.found.reason = "in MR the colon alone is sought";
        return none;
    }
    const auto given = inputs.lumen ? std::optional(givenMask(*inputs.lumen)) : std::nullopt;
    steps::SignalSegmentation found =
        steps::segmentSignal(signal, given, inputs.gravity, inputs.config.get<steps::SegmentOptions>(),
                             inputs.config.get<steps::SignalOptions>(), progress);
    return {std::move(found.found), std::move(found.lumen_scale)};
}

}  // namespace

SegmentedScan segmentScan(const StepInputs& inputs, const steps::OrganOptions& organ, const HuVolume& volume,
                          Progress& progress)
{
    if (inputs.quantity == Quantity::signal)
        return segmentMr(inputs, organ, volume, progress);
    const auto options = inputs.config.get<steps::SegmentOptions>();
    if (!organ.isColon())
        return {steps::segmentOrgan(volume, organ, progress), {}};
    if (inputs.lumen)
        return {steps::segmentGivenColon(volume, givenMask(*inputs.lumen), inputs.gravity, options, progress), {}};
    return {steps::segmentColon(volume, inputs.gravity, options, progress), {}};
}

}  // namespace vicon::pipeline
