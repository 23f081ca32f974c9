#include "segment_step.h"

#include <optional>

#include "step_parameters.h"
#include "vicon/cases/step_results.h"
#include "vicon/core/error.h"
#include "vicon/scan_files/volume_file.h"
#include "vicon/steps/lumen_contrast.h"
#include "vicon/steps/segment.h"

using nlohmann::json;

namespace vicon::pipeline {
namespace {

struct SegmentedScan {
    steps::Segmentation found;
    std::optional<HuVolume> lumen_scale;  ///< of a scan of signal, see steps::onLumenScale()
};

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

/// The lumen of a scan's organ: of a colon the one that a person gave, if there is one. Throws Error{bad_input} where
/// that is lost or damaged.
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

SegmentFound foundBy(const steps::OrganOptions& organ, const steps::Segmentation& segmentation)
{
    SegmentFound found{.verdict = segmentation.verdict,
                       .organ_title = organ.title,
                       .confidence = segmentation.confidence,
                       .reason = segmentation.reason,
                       .organ = Organ(organ.name),
                       .bridges = segmentation.plan.bridges,
                       .plan = toJson(segmentation.plan),
                       .measures = segmentation.measures};
    for (Bridge& bridge : found.bridges)
        bridge.path_mm.clear();
    return found;
}

}  // namespace

// Those of a signal are told only where they are set: the digests of CT scans stay as they are.
json segmentParameters(const Config& config)
{
    json all = parametersByOrgan<steps::SegmentOptions, steps::OrganOptions>(config);
    const json usual = toJson(steps::SignalOptions()), set = toJson(config.get<steps::SignalOptions>());
    for (const auto& [key, value] : set.items())
        if (value != usual.at(key))
            all[key] = value;
    return all;
}

json runSegment(const StepInputs& inputs, ScanResults& results, const StepRecords&, Progress& progress)
{
    const auto organ = inputs.config.get<steps::OrganOptions>();
    SegmentedScan segmented = segmentScan(inputs, organ, results.volume(), progress);
    steps::Segmentation& found = segmented.found;
    SegmentFound told = foundBy(organ, found);
    if (inputs.lumen && organ.isColon())
        told.given = inputs.lumen->origin;
    json result = toJson(told);
    if (found.verdict != Verdict::absent) {
        results.putMask(std::move(found.inside));
        if (segmented.lumen_scale)
            results.putLumenScale(std::move(*segmented.lumen_scale));
        results.densitiesAroundLumen();  // while the whole is there
    }
    return result;
}

std::vector<std::string> segmentFiles(const json& result)
{
    if (segmentFoundFromJson(result).verdict == Verdict::absent)
        return {};
    if (json(result).contains("contrast"))
        return {"mask.mha", "lumen_scale.mha"};
    return {"mask.mha"};
}

}  // namespace vicon::pipeline
